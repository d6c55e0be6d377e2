// How an occluder stands and acts, as controls that the anvil's panel and past edits share.
#pragma once

#include "app/viewer/live_contact.h"
#include "app/viewer/panels/curve_editor.h"
#include "engine/edit/recipe.h"
#include "engine/forge/report.h"

namespace anvil {

// Each returns whether something was changed; `size`: of the scene, world.

bool number_control(const char* label, double& value, float speed, float least, float most);
bool place_control(const char* label, Vec3& place, double size);
bool transform_controls(Transform& transform, double size);
/// `curve` is for influences that are drawn.
bool influence_controls(Influence& influence, double size, CurveEditor& curve);
bool dilation_controls(std::optional<Dilation>& dilation, double size);

/// What is dragged and touches, in words.
void show_live_contact(const LiveContact& contact);
/// What an edit met.
void show_contact(const EditReport& report);
/// Of a closed mesh, from `before` to `after`.
void show_volume(double before, double after);

} // namespace anvil
