#include "engine/occluder/self_intersection.h"

#include "engine/core/parallel_for.h"
#include "engine/mesh/triangle_pairs.h"

#include <atomic>

namespace anvil {

namespace {

using Corners = std::array<Vec3, 3>;

constexpr double rounding = 1e-13; // of products of lengths, relative

// Of volumes against the cube of the largest coordinate from one corner to another: no less than `rounding`
// against the cube of the diagonal.
constexpr double clear_rounding = 5e-12;

/// A triangle of the mesh.
struct Face {
    Corners at;
    Vec3 normal;      ///< twice the area long
    double reach = 0; ///< sum of the coordinates from the first corner to another one, the larger
    Triangle corners;
    uint32_t number = 0;
};

double sum_of_sizes(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

Face face_of(std::span<const Vec3> positions, const Triangle& t, uint32_t number) {
    const Vec3& a = positions[t[0]];
    const Vec3 ab = positions[t[1]] - a;
    const Vec3 ac = positions[t[2]] - a;
    return {{a, positions[t[1]], positions[t[2]]},
            glm::cross(ab, ac),
            std::max(sum_of_sizes(ab), sum_of_sizes(ac)),
            t,
            number};
}

double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

/// -1, 0 or 1; 0 also where rounding may have decided.
int side(double volume, double tolerance) {
    return volume > tolerance ? 1 : volume < -tolerance ? -1 : 0;
}

/// Of a segment in the face's plane: whether a side of the face, or the segment's own line, parts the two.
bool separated_in_plane(const Vec3& p, const Vec3& q, const Face& face, double size) {
    const double tolerance = rounding * size * size * size * size;
    const Vec3 across = glm::cross(face.normal, q - p);
    double least = infinity;
    double most = -infinity;
    for (int i = 0; i < 3; ++i) {
        const Vec3 inward = glm::cross(face.normal, face.at[(i + 1) % 3] - face.at[i]);
        if (glm::dot(inward, p - face.at[i]) <= tolerance && glm::dot(inward, q - face.at[i]) <= tolerance) {
            return true;
        }
        least = std::min(least, glm::dot(across, face.at[i] - p));
        most = std::max(most, glm::dot(across, face.at[i] - p));
    }
    return least >= -tolerance || most <= tolerance;
}

Crossing segment_crossing(const Vec3& p, const Vec3& q, const Face& face, double size) {
    const double tolerance = rounding * size * size * size;
    const int at_p = side(glm::dot(face.normal, p - face.at[0]), tolerance);
    const int at_q = side(glm::dot(face.normal, q - face.at[0]), tolerance);
    if (at_p * at_q > 0 || (at_p == 0 && at_q == 0 && separated_in_plane(p, q, face, size))) {
        return Crossing::none;
    }
    int signs[3];
    for (int i = 0; i < 3; ++i) {
        signs[i] = side(orient(p, q, face.at[i], face.at[(i + 1) % 3]), tolerance);
    }
    const bool left = signs[0] >= 0 && signs[1] >= 0 && signs[2] >= 0;
    const bool right = signs[0] <= 0 && signs[1] <= 0 && signs[2] <= 0;
    if (!left && !right) {
        return Crossing::none;
    }
    const bool clear = at_p != 0 && at_q != 0 && signs[0] != 0 && signs[1] != 0 && signs[2] != 0;
    return clear ? Crossing::crosses : Crossing::unsure;
}

/// Whether one of a's sides, in their common plane, has all of b beyond it.
bool separated_in_plane(const Face& a, const Face& b, double size) {
    const double tolerance = rounding * size * size * size * size;
    for (int i = 0; i < 3; ++i) {
        const Vec3 inward = glm::cross(a.normal, a.at[(i + 1) % 3] - a.at[i]);
        bool beyond = true;
        for (const Vec3& corner : b.at) {
            beyond = beyond && glm::dot(inward, corner - a.at[i]) <= tolerance;
        }
        if (beyond) {
            return true;
        }
    }
    return false;
}

/// All corners of b on a's plane, to rounding.
bool in_plane(const Face& a, const Face& b, double tolerance) {
    return std::all_of(b.at.begin(), b.at.end(), [&](const Vec3& corner) {
        return side(glm::dot(a.normal, corner - a.at[0]), tolerance) == 0;
    });
}

Crossing worse(Crossing a, Crossing b) {
    return std::max(a, b);
}

/// Edges i of each triangle (from corner i to i + 1) that have no common corner with the other.
Crossing edges_crossing(const Face& a, const std::array<bool, 3>& common, const Face& b, double size) {
    Crossing found = Crossing::none;
    for (int i = 0; i < 3; ++i) {
        if (!common[i] && !common[(i + 1) % 3]) {
            found = worse(found, segment_crossing(a.at[i], a.at[(i + 1) % 3], b, size));
        }
    }
    return found;
}

double common_size(const Face& a, const Face& b) {
    Box box;
    for (int i = 0; i < 3; ++i) {
        box.include(a.at[i]);
        box.include(b.at[i]);
    }
    return box.diagonal();
}

/// Whether all corners of b that a has not lie clearly on one side of a's plane: then the two meet in common
/// corners and edges only.
bool clear_of_plane(const Face& a, const Face& b) {
    double reach = a.reach;
    double least = infinity;
    double most = -infinity;
    for (int i = 0; i < 3; ++i) {
        const uint32_t v = b.corners[i];
        if (v != a.corners[0] && v != a.corners[1] && v != a.corners[2]) {
            const Vec3 arm = b.at[i] - a.at[0];
            const double volume = glm::dot(a.normal, arm);
            reach = std::max(reach, sum_of_sizes(arm));
            least = std::min(least, volume);
            most = std::max(most, volume);
        }
    }
    const double tolerance = clear_rounding * reach * reach * reach;
    return least > most ? false : least > tolerance || most < -tolerance;
}

Crossing crossing(const Face& a, const Face& b) {
    std::array<bool, 3> common_a{};
    std::array<bool, 3> common_b{};
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (a.corners[i] == b.corners[j]) {
                common_a[i] = common_b[j] = true;
                ++count;
            }
        }
    }
    const double size = common_size(a, b);
    const double tolerance = rounding * size * size * size;
    if (in_plane(a, b, tolerance)) {
        const bool apart = separated_in_plane(a, b, size) || separated_in_plane(b, a, size);
        return apart ? Crossing::none : Crossing::unsure;
    }
    if (count >= 2) {
        return Crossing::none;
    }
    return worse(edges_crossing(a, common_a, b, size), edges_crossing(b, common_b, a, size));
}

void mark(Crossing& flag, Crossing found) {
    std::atomic_ref<Crossing> shared(flag);
    Crossing known = shared.load(std::memory_order_relaxed);
    while (known < found && !shared.compare_exchange_weak(known, found, std::memory_order_relaxed)) {
    }
}

} // namespace

std::vector<Crossing> find_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                     const SearchTree& tree) {
    std::vector<Crossing> flags(triangles.size(), Crossing::none);
    const TrianglePairs pairs(tree);
    std::vector<Face> faces;
    faces.reserve(triangles.size());
    for (const uint32_t t : tree.order()) {
        faces.push_back(face_of(positions, triangles[t], t));
    }
    const auto compare = [&](uint32_t slot, uint32_t other) {
        const Face& a = faces[slot];
        const Face& b = faces[other];
        if (clear_of_plane(a, b) || clear_of_plane(b, a)) {
            return;
        }
        const Crossing found = a.number < b.number ? crossing(a, b) : crossing(b, a);
        if (found != Crossing::none) {
            mark(flags[a.number], found);
            mark(flags[b.number], found);
        }
    };
    parallel_for(pairs.leaf_count(), 64, [&](size_t begin, size_t end) {
        for (size_t leaf = begin; leaf < end; ++leaf) {
            pairs.each_of(leaf, compare);
        }
    });
    return flags;
}

} // namespace anvil
