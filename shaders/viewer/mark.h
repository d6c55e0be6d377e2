// A mark over the picture; the same text for C++ (with vec4, uint named) and GLSL.
#ifndef ANVIL_MARK_H
#define ANVIL_MARK_H

#define MARK_LINE 0u   // from a to b; a disc where these are one
#define MARK_RING 1u   // about a
#define MARK_SQUARE 2u // about a
#define MARK_FACET 3u  // the triangle a b c

/// Places are pixels from the left and the top, then the depth that the picture's depths are held against.
struct Mark {
    vec4 a; // w: half the width, the radius, half the side, pixels
    vec4 b; // w: half the width of a ring's stroke
    vec4 c;
    uint colour; // red in the lowest eight bits, then green, blue, opacity
    uint kind;
    uint unused_a;
    uint unused_b;
};

#endif
