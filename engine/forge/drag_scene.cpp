#include "engine/forge/drag_scene.h"

namespace anvil {

DragScene::DragScene(const Mesh& mesh, std::span<const Vec3> positions, const RefinementHistory& history,
                     KeptSolvers& solvers, uint64_t number)
    : mesh_(mesh), positions_(positions), surface_(mesh, positions, history, solvers, number),
      incidence_(incident_triangles(mesh.triangles, positions.size())), numbers_(positions.size()),
      frame_(local_frame(mesh)) {}

void DragScene::warm() {
    surface_.solver(0);
}

} // namespace anvil
