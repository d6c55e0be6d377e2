// What tests of the editor have in hand.
#pragma once

#include "app/viewer/editor.h"
#include "engine/mesh/sample_shapes.h"

namespace anvil::test {

/// An editor over a sphere of radius 1, seen from the front.
struct EditedSphere {
    Mesh mesh = make_sample("icosphere", 2562);
    RefinementHistory history{mesh};
    PickSurface surface{mesh, history, mesh.positions};
    OrbitCamera camera;
    Editor editor;

    EditedSphere() {
        camera.set_window(1000, 800);
        camera.frame(mesh.positions, Vec3(0, 0, 1));
        editor.radius = 0.5;
    }

    void send(const InputEvent& event) { editor.handle(event, camera, &surface); }
};

} // namespace anvil::test
