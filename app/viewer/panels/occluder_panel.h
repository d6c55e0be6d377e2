// The anvil's panel: which occluders there are, where they stand and how they act.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

class OccluderPanel {
  public:
    /// A panel of its own, where something is open.
    void show(Session& session);

  private:
    void add(Session& session);

    int shape_ = 0;
    std::string file_;
};

/// A new occluder beside the mesh, named after its shape and unlike all others: a tenth of the mesh's size
/// large. `kind`: a name of occluder_kinds(), or a file of a mesh or level set.
Occluder new_occluder(const Recipe& recipe, const std::string& kind, const Box& scene);
std::vector<std::string> occluder_kinds();
/// About `size` from its centre to its rim; a file's as it is, by its absolute path.
OccluderShape occluder_shape(const std::string& kind, double size);

} // namespace anvil
