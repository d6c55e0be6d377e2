// The recipe: what to do to a mesh, as plain data. File, undo history and replay share it.
#pragma once

#include "engine/edit/distance_method.h"
#include "engine/edit/shape_function.h"
#include "engine/edit/surface_address.h"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace anvil {

/// A shape function by preset name, or by knots where `preset` is empty.
struct ShapeChoice {
    std::string preset = "smooth";
    std::vector<Knot> knots;

    bool operator==(const ShapeChoice&) const = default;
};

/// @throws InputError for an unknown preset or bad knots (see ShapeFunction).
ShapeFunction make_shape_function(const ShapeChoice& choice);

enum class EditKind { translate, rotate };
enum class Sweep { arc, chord };
enum class Metric { geodesic, euclidean };

/// A line in world space; `direction` is not zero and need not be unit.
struct Axis {
    Vec3 origin{0.0};
    Vec3 direction{0, 1, 0};

    bool operator==(const Axis&) const = default;
};

/// A point of the surface with its target: exactly one of `by`, `to` and `path` in a translation, exactly one
/// of `degrees` and `to` in a rotation. radius (world units, > 0), shape and metric win over the edit's.
struct Handle {
    SurfaceAddress at;
    std::optional<Vec3> by;
    std::optional<Vec3> to;
    std::vector<Vec3> path; ///< offsets from the start, at least two; empty: none. See HandlePath
    std::optional<double> degrees;
    std::optional<double> radius;
    std::optional<ShapeChoice> shape;
    std::optional<Metric> metric;

    bool operator==(const Handle&) const = default;
};

/// What the distance of a handle is measured from in place of the handle itself; at most one per handle.
struct Anchors {
    uint32_t handle = 0;
    std::vector<AnchorAddress> at;      ///< at least one
    std::optional<double> smooth_width; ///< of the blend, a length > 0; absent: the nearest anchor counts

    bool operator==(const Anchors&) const = default;
};

/// x -> translate + scale * rotation(axis, degrees) x.
struct Transform {
    Vec3 translate{0.0};
    Vec3 axis{0, 1, 0}; ///< not zero, need not be unit, through the occluder's origin
    double degrees = 0;
    double scale = 1; ///< > 0

    bool operator==(const Transform&) const = default;
};

enum class InfluenceKind { paper, hard, soft, curve };

/// How an occluder acts on what comes near. Members that the kind does not use keep their defaults.
struct Influence {
    InfluenceKind kind = InfluenceKind::soft;
    double strength = 0.9;       ///< soft: in [0, 1]
    std::optional<double> sigma; ///< soft: a length > 0; default 5 % of the occluder's bounding radius
    std::vector<Knot> knots;     ///< curve: a shape function of distance over width, within [-1, 1]
    double width = 0;            ///< curve: a length > 0

    bool operator==(const Influence&) const = default;
};

/// Shapes stand centred at their own origin, axes along y, all lengths > 0 unless said otherwise.
struct SphereShape {
    double radius = 1;

    bool operator==(const SphereShape&) const = default;
};

/// Outer half extents; `rounding` in [0, shortest half extent] takes the edges away and adds nothing.
struct BoxShape {
    Vec3 half{1.0};
    double rounding = 0;

    bool operator==(const BoxShape&) const = default;
};

struct CylinderShape {
    double radius = 1;
    double height = 1; ///< whole height, from -height/2 to height/2

    bool operator==(const CylinderShape&) const = default;
};

/// All points within `radius` of the segment from -height/2 to height/2.
struct CapsuleShape {
    double radius = 1;
    double height = 1;

    bool operator==(const CapsuleShape&) const = default;
};

/// Base disc of `radius` at y = -height/2, tip at y = height/2.
struct ConeShape {
    double radius = 1;
    double height = 1;

    bool operator==(const ConeShape&) const = default;
};

/// Circle of radius `major` about the y axis, tube of radius `minor` <= major.
struct TorusShape {
    double major = 1;
    double minor = 0.25;

    bool operator==(const TorusShape&) const = default;
};

/// Inside is where dot(x, unit normal) < offset. `normal` is not zero and need not be unit.
struct PlaneShape {
    Vec3 normal{0, 1, 0};
    double offset = 0;

    bool operator==(const PlaneShape&) const = default;
};

enum class CsgOperation { unite, intersect, subtract };

struct CsgPart;

/// `subtract` takes all further parts from the first. At least one part.
struct CsgShape {
    CsgOperation operation = CsgOperation::unite;
    std::vector<CsgPart> parts;

    bool operator==(const CsgShape& other) const;
};

/// A triangle or polygon mesh as a solid, in the mesh's own coordinates.
struct MeshShape {
    std::string file; ///< as written: relative to the recipe's folder

    bool operator==(const MeshShape&) const = default;
};

/// A level set of an OpenVDB file as a solid, in the grid's world space.
struct VdbShape {
    std::string file; ///< as written: relative to the recipe's folder
    std::string grid; ///< empty: the file's only level set

    bool operator==(const VdbShape&) const = default;
};

/// The solid of an occluder.
struct OccluderShape {
    using Solid = std::variant<SphereShape, BoxShape, CylinderShape, CapsuleShape, ConeShape, TorusShape,
                               PlaneShape, MeshShape, VdbShape, CsgShape>;
    Solid solid;

    bool operator==(const OccluderShape&) const = default;
};

/// A shape at its place within a CSG shape; the name is the user's note.
struct CsgPart {
    std::string name;
    OccluderShape shape;
    Transform transform;

    bool operator==(const CsgPart&) const = default;
};

/// Whether the solid lies in some ball, as far as its operations tell: a plane does not, a union must be
/// bounded in all parts, an intersection in one, a difference in the first.
bool is_bounded(const OccluderShape& shape);

/// Whether the shape has a formula that kernels evaluate: no file is part of it.
bool has_formula(const OccluderShape& shape);

enum class FieldKind { exact, dense, adaptive };

/// How an occluder is evaluated: by formula, or from baked samples with `resolution` voxels (8 to 1024)
/// along its longest side, everywhere (dense) or where the surface is near (adaptive).
struct Field {
    FieldKind kind = FieldKind::exact;
    uint32_t resolution = 128;

    bool operator==(const Field&) const = default;
};

struct Occluder {
    std::string name; ///< unique, not empty
    OccluderShape shape;
    std::optional<Field> field; ///< absent: exact where there is a formula
    Transform transform;
    Influence influence;

    bool operator==(const Occluder&) const = default;
};

/// Where a moving occluder is at a time of the edit; what is absent is that of its transform.
struct MotionPose {
    struct Turn {
        Vec3 axis{0, 1, 0}; ///< as Transform::axis
        double degrees = 0;

        bool operator==(const Turn&) const = default;
    };

    double at = 0; ///< in [0, 1]
    std::optional<Vec3> translate;
    std::optional<Turn> rotate;
    std::optional<double> scale;

    bool operator==(const MotionPose&) const = default;
};

/// An occluder in one edit; what is given replaces the occluder's own as a whole.
struct OccluderUse {
    std::string name;
    std::optional<Transform> transform;
    std::optional<Influence> influence;
    std::vector<MotionPose> motion; ///< empty, or two and more with ascending times: a hammer

    bool operator==(const OccluderUse&) const = default;
};

/// `count` equal steps of the path, or adaptive ones of which a vertex takes at most `count`; 1 to 1e6.
struct Steps {
    bool adaptive = true;
    uint32_t count = 4096;

    bool operator==(const Steps&) const = default;
};

enum class RefineCriterion { shape, space, both };

/// Adaptive refinement: vertices where linear interpolation misses the edit by more than the tolerance.
struct Refine {
    RefineCriterion criterion = RefineCriterion::shape;
    double shape_tolerance = 0.001; ///< dimensionless, > 0; of the weights
    double space_tolerance = 0;     ///< world units, > 0 where the criterion needs it; of the moved surface
    double min_edge = 0;            ///< world units: no edge is cut into shorter pieces
    std::optional<uint32_t> max_vertices; ///< of the mesh; absent: 1,000,000, or twice what it has
    bool flip = false;                    ///< flip new edges for larger angles
    bool relax = false;                   ///< slide new vertices along the edges that they cut, for the same

    bool operator==(const Refine&) const = default;
};

enum class DilationForm { depth, volume };

/// Contact dilation: what an occluder pushes away swells up beside it.
struct Dilation {
    DilationForm form = DilationForm::depth;
    double amount = 1;           ///< share of the depth or volume that comes back, in [0, 100]
    bool solve = false;          ///< volume form: the amount that keeps the volume; `amount` is then not used
    std::optional<double> width; ///< a length > 0; default: half of the edit's radius of influence

    bool operator==(const Dilation&) const = default;
};

/// What an edit does on one side of a plane it does on the other one too.
struct Mirror {
    int axis = 0;                ///< the plane stands upright on x (0), y or z
    double origin = 0;           ///< where on the axis
    std::optional<double> merge; ///< a length > 0: handles nearer to the plane stay single; default 0.5 % of
                                 ///< the mesh's diagonal

    bool operator==(const Mirror&) const = default;
};

struct Edit {
    EditKind kind = EditKind::translate;
    std::vector<Handle> handles; ///< at least one, or none where an occluder moves
    std::vector<Anchors> anchors;
    std::vector<SurfaceAddress> pinned;
    Axis axis;                ///< rotations
    Sweep sweep = Sweep::arc; ///< rotations
    Metric metric = Metric::geodesic;
    DistanceMethod method = DistanceMethod::automatic;
    uint32_t smooth_surface = 0;  ///< geodesic distances are measured on a copy smoothed by so many rounds
    std::optional<double> radius; ///< world units, > 0; default: half of the handle's largest finite distance
    ShapeChoice shape;
    std::optional<std::vector<OccluderUse>> occluders; ///< absent: all occluders of the recipe as they stand
    std::optional<Steps> steps; ///< absent: adaptive, at most 4096; 32 equal ones for `paper`
    bool least_squares = false;
    std::optional<Refine> refine; ///< absent: the mesh keeps its vertices
    double amount = 1;            ///< in [0, 1]
    std::optional<Dilation> dilation;
    std::optional<Mirror> mirror;

    bool operator==(const Edit&) const = default;
};

struct Recipe {
    std::string file; ///< where it was read from; in messages, and `mesh` is relative to its folder
    std::string mesh; ///< as written; see mesh_path()
    std::vector<Occluder> occluders;
    std::vector<Edit> edits;

    bool operator==(const Recipe&) const = default;
};

/// Where the mesh lies: `mesh` itself if absolute, else within the folder of `file`.
std::filesystem::path mesh_path(const Recipe& recipe);

/// The uses that hold for an edit: its own, or all occluders of the recipe; every entry with transform and
/// influence filled in. Names must be known.
std::vector<OccluderUse> occluders_of(const Recipe& recipe, const Edit& edit);

/// How the occluder is evaluated: its own field, or the default: exact where there is a formula, else
/// adaptive.
Field field_of(const Occluder& occluder);

/// The folder that the recipe's paths are relative to.
std::filesystem::path recipe_folder(const Recipe& recipe);

/// The occluder of that name; nullptr if there is none.
const Occluder* find_occluder(const Recipe& recipe, const std::string& name);

} // namespace anvil
