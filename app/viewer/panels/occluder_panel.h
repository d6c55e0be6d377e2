// The anvil's panel: which occluders there are, where they stand and how they act.
#pragma once

#include "app/viewer/panels/curve_editor.h"
#include "app/viewer/panels/panel_column.h"
#include "app/viewer/session.h"

namespace anvil {

class OccluderPanel {
  public:
    /// A panel of its own, where something is open.
    void show(Session& session, PanelColumn& column);

  private:
    void add(Session& session);
    void show_one(Session& session, size_t index);
    void show_settings(Session& session, size_t index);

    int shape_ = 0;
    std::string file_;
    std::string opened_;   ///< the occluder that was last selected by its entry, or opened since it was
    CurveEditor curve_{1}; ///< of the selected one's influence: formats allow no more
};

/// A new occluder beside the mesh, named after its shape and unlike all others: a tenth of the mesh's size
/// large. `kind`: a name of occluder_kinds(), or a file of a mesh or level set.
Occluder new_occluder(const Recipe& recipe, const std::string& kind, const Box& scene);
std::vector<std::string> occluder_kinds();
/// About `size` from its centre to its rim; a file's as it is, by its absolute path.
OccluderShape occluder_shape(const std::string& kind, double size);

} // namespace anvil
