// Which triangles of a search tree may be nearest to a point, alike in C++ and GLSL. In single precision,
// with bounds on what that rounds away: the nearest one is always among them. The includer provides the
// structs of search_tree.h, tree_size(), tree_node(i), tree_triangle(i), flat_squared_distance(), and
// found_near(i), which is told their numbers.

// A point's coordinates are off by 2^-24 of them, a triangle's origin, at most 1/2 away, by 2^-26: by twice
// this times (1/2 + the largest coordinate), and the root of three times as far.
const real PLACE_ROUNDING = real(1.0 / 4194304.0);

// Roots and squares of single precision are off by less.
const real ROOT_ROUNDING = real(1e-6);

const real FARTHEST = real(1e30); // squared

// What squared distances are at least and at most.
struct SquaredBounds {
    real low;
    real high;
};

// How far a point may be from where it is taken to be, a triangle's origin included.
real place_error(real3 q) {
    return PLACE_ROUNDING * (real(0.5) + max(abs(q.x), max(abs(q.y), abs(q.z))));
}

SquaredBounds measured(real3 q, uint triangle) {
    TreeTriangle t = tree_triangle(triangle);
    real3 w = q - t.origin;
    real squared = flat_squared_distance(dot(w, w), dot(t.x_axis, w), dot(t.y_axis, w), t.b, t.cx, t.cy,
                                         t.ac2_inverse, t.bc2_inverse);
    real lengths = t.b + abs(w.x) + abs(w.y) + abs(w.z) + place_error(q);
    real error = lengths * (FLAT_ROUNDING * lengths + real(2.0) * (t.slack + place_error(q)));
    SquaredBounds bounds;
    bounds.low = squared - error;
    bounds.high = squared + error;
    return bounds;
}

real squared_from_box(real3 q, TreeNode node) {
    real3 arm = max(max(node.low - q, q - node.high), real3(0.0));
    return dot(arm, arm);
}

// What the squared distance to a box is at most where something in it is within a squared distance.
real box_limit(real3 q, real limit) {
    real reach = sqrt(max(limit, real(0.0))) * (real(1.0) + ROOT_ROUNDING) + place_error(q);
    return reach * reach * (real(1.0) + ROOT_ROUNDING);
}

// What the squared distance of the nearest triangle is at most: by the leaf in the nearer half of the nearer
// half and so on, most often a good guess.
real guessed_limit(real3 q) {
    uint index = 0u;
    TreeNode node = tree_node(index);
    while (node.count == 0u) {
        TreeNode left = tree_node(index + 1u);
        uint beyond_left = left.count > 0u ? index + 2u : left.first;
        TreeNode right = tree_node(beyond_left);
        bool goes_left = squared_from_box(q, left) <= squared_from_box(q, right);
        index = goes_left ? index + 1u : beyond_left;
        node = tree_node(index);
    }
    real limit = FARTHEST;
    for (uint i = 0u; i < node.count; ++i) {
        limit = min(limit, measured(q, node.first + i).high);
    }
    return limit;
}

// Two walks through the tree, without anything to remember on the way: one for the limit, one for all that is
// within.
void find_nearest(real3 q) {
    real limit = guessed_limit(q);
    for (uint walk = 0u; walk < 2u; ++walk) {
        real within = box_limit(q, limit);
        uint index = 0u;
        while (index < tree_size()) {
            TreeNode node = tree_node(index);
            if (squared_from_box(q, node) > within) {
                index = node.count > 0u ? index + 1u : node.first;
                continue;
            }
            ++index;
            for (uint i = 0u; i < node.count; ++i) {
                SquaredBounds bounds = measured(q, node.first + i);
                if (walk == 0u && bounds.high < limit) {
                    limit = bounds.high;
                    within = box_limit(q, limit);
                } else if (walk == 1u && !(bounds.low > limit)) {
                    found_near(node.first + i);
                }
            }
        }
    }
}
