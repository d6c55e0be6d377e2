#include "app/viewer/panels/key_help.h"

#include <imgui.h>

namespace anvil {

namespace {

constexpr const char* key_help =
    "Surface\n"
    "  drag                 move the point under the cursor (turn it, with the turn tool)\n"
    "  Shift+click          another handle\n"
    "  G / R                move / turn tool; with handles: move or turn them until Enter or a click\n"
    "  A / P                clicks set anchors of the handle / pins\n"
    "  L                    clicks draw a line along the surface; Enter, or a click at its last point, ends "
    "it:\n"
    "                       a handle, or an anchor of the handle that is there (Shift: another handle)\n"
    "  Enter / Esc          take / drop the edit\n"
    "While dragging\n"
    "  X Y Z N              along an axis or the normal; with Shift: in the plane across it\n"
    "  digits - .           a length or an angle\n"
    "  wheel                radius\n"
    "  Ctrl / Shift         snap / move precisely\n"
    "  Enter / Esc, right   take / cancel\n"
    "Selection\n"
    "  B / Shift+B          box / lasso; Shift adds, Ctrl takes away     V   through the surface\n"
    "  Ctrl+A, Ctrl+Shift+A all, none     Ctrl+I   invert     + -   grow, shrink\n"
    "  H, Shift+H, Alt+H    hide what is selected, hide the rest, show all\n"
    "  Ctrl+P, Ctrl+Shift+P pin it for all edits, unpin     Shift+A   anchors of the handle\n"
    "Occluders\n"
    "  click, O             select one: beside the surface, or wherever clicks select them alone\n"
    "  drag its marks       arrows, squares: move; rings: turn; corner: scale; keys as above\n"
    "  Enter / Esc          take / drop a recorded motion; Esc: select none\n"
    "View\n"
    "  middle, Alt+left     turn        Shift+middle, Alt+middle   move\n"
    "  wheel                zoom to the cursor (Ctrl+wheel with handles: radius)\n"
    "  1 3 7, with Shift    front right top, back left bottom     5   parallel view\n"
    "  F / Home             show what is selected or the region / all     T   trackball or turntable\n"
    "  W S I                edges, flat shading, lines of equal distance\n"
    "  D                    distances along the surface or straight\n"
    "Curve\n"
    "  drag a knot or the end of its slope (Alt: one side, a kink)\n"
    "  double click: a new knot     right click: without it\n"
    "Program\n"
    "  Ctrl+Z, Ctrl+Shift+Z undo, redo\n"
    "  Ctrl+O, Ctrl+S       open, save the recipe (Shift: under another name)\n"
    "  F12                  save a picture     F2   mesh and times     Tab   panels     F1   this help\n";

} // namespace

void show_key_help(bool& open) {
    if (!open) {
        return;
    }
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x / 2, ImGui::GetIO().DisplaySize.y / 2),
                            ImGuiCond_Always, ImVec2(0.5F, 0.5F));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImGui::GetIO().DisplaySize);
    ImGui::Begin("Keys", &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    ImGui::TextUnformatted(key_help);
    ImGui::End();
}

} // namespace anvil
