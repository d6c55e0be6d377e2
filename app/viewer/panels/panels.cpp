#include "app/viewer/panels/panels.h"

#include "app/viewer/panels/facts_panel.h"
#include "app/viewer/panels/key_help.h"
#include "app/viewer/panels/menu_bar.h"

namespace anvil {

void Panels::show(Session& session, const FrameTimes& times) {
    show_menu(session, files);
    const float foot = status_height(session, times);
    PanelColumn left(PanelColumn::Side::left, foot);
    if (session.view.panels && PanelColumn::has_room()) {
        edits_.show(session, left);
        PanelColumn right(PanelColumn::Side::right, foot);
        edit_.show(session, right);
        occluders_.show(session, right);
    }
    show_facts(session, left, session.view.facts);
    show_status(session, times);
    show_notices(session, foot);
    files.show(session);
    show_key_help(session.view.help);
}

} // namespace anvil
