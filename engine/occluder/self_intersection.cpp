#include "engine/occluder/self_intersection.h"

#include "engine/core/parallel_for.h"

#include <atomic>

namespace anvil {

namespace {

using Corners = std::array<Vec3, 3>;

constexpr double rounding = 1e-13; // of products of lengths, relative

/// A triangle with its normal, twice the area long.
struct Face {
    Corners at;
    Vec3 normal;
};

Face face_of(const Corners& at) {
    return {at, glm::cross(at[1] - at[0], at[2] - at[0])};
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

Crossing crossing(const Face& a, const Triangle& s, const Face& b, const Triangle& t) {
    std::array<bool, 3> common_a{};
    std::array<bool, 3> common_b{};
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (s[i] == t[j]) {
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
    const auto face = [&](uint32_t t) {
        const Triangle& corners = triangles[t];
        return face_of({positions[corners[0]], positions[corners[1]], positions[corners[2]]});
    };
    parallel_for(triangles.size(), 256, [&](size_t begin, size_t end) {
        for (auto t = static_cast<uint32_t>(begin); t < end; ++t) {
            const Face a = face(t);
            Box box;
            for (const Vec3& corner : a.at) {
                box.include(corner);
            }
            tree.each_near(box, 0, [&](uint32_t other) {
                if (other <= t) {
                    return true;
                }
                const Face b = face(other);
                const Crossing found = crossing(a, triangles[t], b, triangles[other]);
                if (found != Crossing::none) {
                    mark(flags[t], found);
                    mark(flags[other], found);
                }
                return true;
            });
        }
    });
    return flags;
}

} // namespace anvil
