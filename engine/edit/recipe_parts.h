// The parts of a recipe's JSON, between the file format and the plain structs.
#pragma once

#include "engine/edit/json_reader.h"
#include "engine/edit/recipe.h"

#include <nlohmann/json_fwd.hpp>

namespace anvil {

// All readers throw InputError with file, path, what was found and what would mend it.
std::vector<Knot> read_knots(const JsonReader& list);
ShapeChoice read_shape(const JsonReader& shape);
SurfaceAddress read_address(const JsonReader& point);
std::vector<SurfaceAddress> read_addresses(const JsonReader& list);
AnchorAddress read_anchor(const JsonReader& anchor);
Transform read_transform(const JsonReader& transform);
/// translate, rotate and scale, beside whatever other keys.
Transform read_pose_keys(const JsonReader& transform);
Influence read_influence(const JsonReader& influence);
OccluderShape read_occluder_shape(const JsonReader& shape);
Occluder read_occluder(const JsonReader& occluder);
OccluderUse read_occluder_use(const JsonReader& use);
std::vector<MotionPose> read_motion(const JsonReader& list);
Refine read_refine(const JsonReader& refine);
Dilation read_dilation(const JsonReader& dilation);
Mirror read_mirror(const JsonReader& mirror);
Edit read_edit(const JsonReader& edit);

nlohmann::ordered_json written(const Vec3& v);
nlohmann::ordered_json written(const std::vector<Knot>& knots);
nlohmann::ordered_json written(const ShapeChoice& shape);
nlohmann::ordered_json written(const SurfaceAddress& address);
nlohmann::ordered_json written(const AnchorAddress& anchor);
nlohmann::ordered_json written(const Transform& transform);
nlohmann::ordered_json written(const Influence& influence);
nlohmann::ordered_json written(const OccluderShape& shape);
nlohmann::ordered_json written(const Occluder& occluder);
nlohmann::ordered_json written(const MotionPose& pose);
nlohmann::ordered_json written(const OccluderUse& use);
nlohmann::ordered_json written(const Handle& handle);
nlohmann::ordered_json written(const Anchors& anchors);
nlohmann::ordered_json written(const Refine& refine);
nlohmann::ordered_json written(const Dilation& dilation);
nlohmann::ordered_json written(const Mirror& mirror);
nlohmann::ordered_json written(const Edit& edit);

} // namespace anvil
