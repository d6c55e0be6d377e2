// What walk.h looks at the occluders for, alike in C++ and GLSL; apart, since its functions are members in
// C++.

// What the next look at the occluders is for.
const uint LOOK_NONE = 0u;   // the vertex is at the end of its segment
const uint LOOK_AHEAD = 1u;  // none: it is to take its next step
const uint LOOK_START = 2u;  // what is there before it moves?
const uint LOOK_STEP = 3u;   // where does its step lead?
const uint LOOK_HELD = 4u;   // has a correction put it on the level that it is held at?
const uint LOOK_RAISE = 5u;  // the same for a vertex that comes from below the margin and was not held yet
const uint LOOK_INSIDE = 6u; // is it still inside after its step?
const uint LOOK_PUSHED = 7u; // and after the push outward?
const uint LOOK_REST = 8u;   // what is there now that it stays behind, with an occluder that moves?
const uint LOOK_DOWN = 9u;   // is it at its true level?

// When a held vertex is lowered from the margin to its true level.
const uint LOWERS_NEVER = 0u;
const uint LOWERS_STOPPED = 1u; // at the step limit
const uint LOWERS_ENDED = 2u;   // and at the end of its segment, which is the last

const uint LOWERING_LIMIT = 4u; // corrections of a vertex that is lowered to its true level
