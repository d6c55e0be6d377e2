// A mesh's search tree as kernels read it: what crosses from C++ to GLSL. Lengths are in units of the tree's
// diagonal, places relative to the middle of its box.

// A node's box, rounded outwards. Leaf: `count` triangles from number `first` on; inner node: count = 0, its
// first child is the next node, and what is beyond its last one's last descendant is node `first`.
struct TreeNode {
    real3 low;
    uint first;
    real3 high;
    uint count;
};

// A triangle in its own plane, its longest side from `origin` along x_axis: the other corners at (b, 0) and
// (cx, cy). The inverses are of the squared lengths of the sides from c, 0 for none. slack: the farthest that
// a point of the triangle is from what stands here.
struct TreeTriangle {
    real3 origin;
    real3 x_axis;
    real3 y_axis;
    real b;
    real cx;
    real cy;
    real ac2_inverse;
    real bc2_inverse;
    real slack;
};

// How many triangles a search keeps that single precision does not tell apart; a vertex of an ordinary mesh
// has six.
const uint MOST_NEAR = 8u;
const uint NO_TRIANGLE = 0xffffffffu;

// What flat_squared_distance() may be off where no length at work exceeds R, as a share of R^2: rounded
// inputs and three scalar products make at most 70 units of 2^-24, and a point beyond a corner as sharp as
// flattened() leaves any, taken for one inside, 97.
const real FLAT_ROUNDING = real(256.0 / 16777216.0);
