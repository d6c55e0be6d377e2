#include "engine/mesh/sample_primitives.h"
#include "engine/mesh/triangle_mesh.h"

#include <map>
#include <numbers>

namespace anvil::sample {

namespace {

struct Icosahedron {
    std::vector<Vec3> corners;
    std::vector<Triangle> faces;
};

/// The twelve points (0, +-1, +-phi) and their cyclic shifts; faces are the triples at the least distance, 2.
Icosahedron icosahedron() {
    Icosahedron result;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double one : {-1.0, 1.0}) {
            for (const double phi : {-std::numbers::phi, std::numbers::phi}) {
                Vec3 p(0);
                p[(axis + 1) % 3] = one;
                p[(axis + 2) % 3] = phi;
                result.corners.push_back(p);
            }
        }
    }
    const auto near = [&](uint32_t a, uint32_t b) {
        return glm::distance(result.corners[a], result.corners[b]) < 2.1;
    };
    for (uint32_t a = 0; a < 12; ++a) {
        for (uint32_t b = a + 1; b < 12; ++b) {
            for (uint32_t c = b + 1; c < 12; ++c) {
                if (near(a, b) && near(b, c) && near(c, a)) {
                    const Vec3 normal = glm::cross(result.corners[b] - result.corners[a],
                                                   result.corners[c] - result.corners[a]);
                    const bool outward = glm::dot(normal, result.corners[a]) > 0;
                    result.faces.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
                }
            }
        }
    }
    return result;
}

/// Numbers the points of the cut faces so that neighbours share those of their common edge.
class Numbering {
  public:
    explicit Numbering(size_t frequency) : f_(static_cast<uint32_t>(frequency)) {}

    /// Point with weights (f - i - j, i, j) / f of the face's corners.
    uint32_t at(size_t face, const Triangle& corners, uint32_t i, uint32_t j) {
        const std::array<uint32_t, 3> weight{f_ - i - j, i, j};
        for (size_t k = 0; k < 3; ++k) {
            if (weight[k] == f_) {
                return corners[k];
            }
        }
        for (size_t k = 0; k < 3; ++k) {
            if (weight[k] == 0) {
                return on_edge(corners[(k + 1) % 3], corners[(k + 2) % 3], weight[(k + 2) % 3]);
            }
        }
        const uint32_t inner = (f_ - 1) * (f_ - 2) / 2;
        const uint32_t before = (i - 1) * (f_ - 1) - i * (i - 1) / 2; // points of the rows 1 .. i - 1
        return 12 + 30 * (f_ - 1) + static_cast<uint32_t>(face) * inner + before + j - 1;
    }

  private:
    uint32_t on_edge(uint32_t a, uint32_t b, uint32_t steps_to_b) {
        const auto number =
            edges_.emplace(std::minmax(a, b), static_cast<uint32_t>(edges_.size())).first->second;
        return 12 + number * (f_ - 1) + (a < b ? steps_to_b : f_ - steps_to_b) - 1;
    }

    uint32_t f_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges_;
};

} // namespace

Mesh geodesic_sphere(size_t frequency) {
    const Icosahedron solid = icosahedron();
    const auto f = static_cast<uint32_t>(frequency);
    Numbering number(frequency);
    std::vector<Vec3> positions(10 * frequency * frequency + 2);
    std::vector<Triangle> triangles;
    triangles.reserve(20 * frequency * frequency);
    for (size_t face = 0; face < solid.faces.size(); ++face) {
        const Triangle& t = solid.faces[face];
        for (uint32_t i = 0; i <= f; ++i) {
            for (uint32_t j = 0; i + j <= f; ++j) {
                const Vec3 p = solid.corners[t[0]] * double(f - i - j) + solid.corners[t[1]] * double(i) +
                               solid.corners[t[2]] * double(j);
                positions[number.at(face, t, i, j)] = glm::normalize(p);
                if (i + j < f) {
                    triangles.push_back({number.at(face, t, i, j), number.at(face, t, i + 1, j),
                                         number.at(face, t, i, j + 1)});
                }
                if (i + j + 1 < f) {
                    triangles.push_back({number.at(face, t, i + 1, j), number.at(face, t, i + 1, j + 1),
                                         number.at(face, t, i, j + 1)});
                }
            }
        }
    }
    return mesh_of_triangles(std::move(positions), std::move(triangles));
}

} // namespace anvil::sample
