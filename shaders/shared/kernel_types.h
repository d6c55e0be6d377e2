// What crosses from C++ to GLSL, once. The includer defines real, real3 and uint: C++ includes this file for
// float (the GPU's layout, scalar) and for double (the reference). Lengths are world units relative to the
// mesh's origin.

// One cubic of a shape function: phi(t) = c0 + s (c1 + s (c2 + s c3)), s = t - begin, from `begin` to the
// next one.
struct ShapeSegment {
    real begin;
    real c0;
    real c1;
    real c2;
    real c3;
};

// A run of ShapeSegments: the shape function of one handle, or an occluder's own influence curve.
struct CurveRange {
    uint first;
    uint count;
};

// ShapeNode::kind. Leaves push a distance, operators combine the two on top (postfix order).
const uint SHAPE_SPHERE = 0u;
const uint SHAPE_BOX = 1u;
const uint SHAPE_CYLINDER = 2u;
const uint SHAPE_CAPSULE = 3u;
const uint SHAPE_CONE = 4u;
const uint SHAPE_TORUS = 5u;
const uint SHAPE_PLANE = 6u;
const uint SHAPE_VOLUME = 7u; // sampled densely
const uint SHAPE_BRICKS = 8u; // sampled adaptively
const uint SHAPE_UNION = 9u;
const uint SHAPE_INTERSECTION = 10u;
const uint SHAPE_SUBTRACTION = 11u;
const uint MAX_SHAPE_STACK = 8u; // operands that wait at once
const uint MAX_VOLUMES = 8u;     // densely sampled fields of one edit

// An adaptively sampled field is a run of words: first a table with one word for each brick of the finest
// level in its box, x fastest, about the brick that holds this place: its level << BRICK_LEVEL_SHIFT, the
// exponent e of its range << BRICK_RANGE_SHIFT, and in the low bits the word where its samples begin. A brick
// of level l has BRICK_CELLS cells along each side, each 2^l voxels wide, and samples at their corners, x
// fastest. In a sample the low 12 bits, signed, are the distance in units of 2^e / BRICK_DISTANCES voxels;
// above them are the outward normal's octahedral coordinates, 10 bits each, signed, in units of 1 /
// BRICK_NORMALS.
const uint BRICK_CELLS = 4u;
const uint BRICK_SIDE = 5u; // samples
const uint BRICK_RANGE_SHIFT = 25u;
const uint BRICK_LEVEL_SHIFT = 29u;
const real BRICK_DISTANCES = 2047.0;
const real BRICK_NORMALS = 511.0;

// A leaf or operator of an occluder. Leaf space: axes rows axis_x..z, `origin` and `scale` as seen from the
// occluder's space. size: sphere (radius), box (half extents), cylinder, capsule, cone (radius, half height),
// torus (major, minor), plane (unit normal), volume and bricks (half extents of the box of outermost
// samples). extra: box rounding, plane offset, voxel width. volume: which one of its kind. words: where the
// words of an adaptive field begin among those of all.
struct ShapeNode {
    uint kind;
    uint volume;
    uint words;
    real3 size;
    real extra;
    real3 axis_x;
    real3 axis_y;
    real3 axis_z;
    real3 origin;
    real scale;
};

// Occluder::influence
const uint INFLUENCE_HARD = 0u;
const uint INFLUENCE_SOFT = 1u;
const uint INFLUENCE_CURVE = 2u;
const uint INFLUENCE_PAPER = 3u;

// An occluder's pose (rows of the rotation into its space, origin, uniform scale), its shape and how it acts:
// contact at level `margin` (m) with steps of at least `step` (h / 2), settling at `settle` (e); the
// influence's strength and width (sigma of `soft`, w of a curve). boxed: 1: it lies in a box with sides along
// its own axes, box_centre and box_half in its own space; 0: no such box is known.
struct Occluder {
    real3 axis_x;
    real3 axis_y;
    real3 axis_z;
    real3 origin;
    real scale;
    uint first_node;
    uint node_count;
    real margin;
    real step;
    real settle;
    uint influence;
    real strength;
    real width;
    CurveRange curve;
    uint boxed;
    real3 box_centre;
    real3 box_half;
};

// Where an occluder is at a sample of the path, and how it goes on to the next one (shares of both linear,
// scale by its logarithm). The rows turn from the world at this sample to where the occluder's own pose is.
struct Pose {
    real3 axis_x;
    real3 axis_y;
    real3 axis_z;
    real3 origin;
    real3 move;
    real3 turn_axis; // through the origin, unit
    real turn;       // radians
    real ratio;      // of its scale to that of its own pose
    real growth;     // logarithm of the next scale over this one
    real at;         // the sample's time in [0, 1]
};

const uint MOTION_STRAIGHT = 0u;
const uint MOTION_ARC = 1u;   // rotation, swept along the arc
const uint MOTION_CHORD = 2u; // rotation, swept along the chord from start to end
const uint STEPS_ADAPTIVE = 0u;
const uint STEPS_FIXED = 1u; // of which those that meet nothing are left out
const uint STEPS_EVERY = 2u; // the same steps, none left out

// One edit's motion (push constants; 68 bytes in float).
struct KernelParams {
    uint point_count;
    uint field_stride; // entries of `fields` between two handles
    uint handle_count;
    uint sample_count; // path samples; a straight path has 1
    uint occluder_count;
    uint motion;
    uint steps;
    uint step_limit; // fixed: the number of steps; adaptive: the most a vertex may take
    uint paper;      // 1: all occluders act by the paper's literal influence
    uint moving;     // 1: occluders move: there are poses
    real3 axis_origin;
    real3 axis_direction;
    real path_epsilon; // paths shorter than this do not move a vertex
};

// VertexResult::flags
const uint VERTEX_STARTED_INSIDE = 1u;
const uint VERTEX_LIMIT_REACHED = 2u;
const uint VERTEX_TOUCHED = 4u;

// What the kernel says of one vertex.
struct VertexResult {
    real3 displacement;
    uint steps;
    uint samples;
    uint flags;
};

// The two other corners of a triangle, in its order, as seen from one of them.
struct FanCorner {
    uint b;
    uint c;
};

const real NEWTON_TOLERANCE = 1e-4; // of the occluder's step, when a vertex is put back on a level
const uint NEWTON_LIMIT = 8u;
const real CORNER_DEPTH =
    0.1; // of the step: below the level by more, after NEWTON_LIMIT projections, is a corner
const real SOFT_REACH = 4.0;    // in sigma: exp(-16) is below float's resolution
const real SOFT_FINENESS = 8.0; // steps per sigma within the reach
const real CURVE_FINENESS = 32.0;
const real BOX_SAFETY = 1.05; // of an influence's reach: fields err by up to 4 % of far distances
