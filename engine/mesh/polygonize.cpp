#include "engine/mesh/polygonize.h"

#include "engine/core/parallel_for.h"
#include "engine/mesh/contour_cell.h"
#include "engine/mesh/contour_grid.h"
#include "engine/mesh/triangle_mesh.h"

#include <Eigen/Eigenvalues>

namespace anvil {

namespace {

using contour::Cell;
using contour::Grid;
using contour::Index3;

constexpr size_t grain = 256;

struct Crossing {
    Vec3 point;
    Vec3 normal; ///< unit, or 0 where f has no gradient
};

/// Where f changes sign between a and b: regula falsi with the end that stays weighed down (Illinois).
Vec3 find_root(const ScalarField& f, Vec3 a, double fa, Vec3 b, double fb, double size) {
    for (int i = 0; i < 30 && fa != fb && glm::length(b - a) > 1e-9 * size; ++i) {
        const double t = std::clamp(fa / (fa - fb), 0.01, 0.99);
        const Vec3 m = a + t * (b - a);
        const double value = f(m);
        const double fm = value == value ? value : 0;
        if (std::abs(fm) < 1e-12 * size) {
            return m;
        }
        if ((fm < 0) == (fa < 0)) {
            a = m;
            fa = fm;
            fb *= 0.5;
        } else {
            b = m;
            fb = fm;
            fa *= 0.5;
        }
    }
    return std::abs(fa) < std::abs(fb) ? a : b;
}

Vec3 gradient(const ScalarField& f, const Vec3& p, double step) {
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 ahead = p;
        Vec3 behind = p;
        ahead[axis] += step;
        behind[axis] -= step;
        result[axis] = (f(ahead) - f(behind)) / (ahead[axis] - behind[axis]);
    }
    return is_finite(result) ? result : Vec3(0);
}

class Contour {
  public:
    Contour(const ScalarField& f, const Box& box, const PolygonizeOptions& options)
        : f_(f), grid_(f, box, options), step_(1e-4 * grid_.cell_size()), sharp_(options.sharp) {}

    Mesh run() {
        find_sheets();
        separate_sheets();
        find_crossings();
        place_vertices();
        return mesh_of_triangles(std::move(vertices_), make_triangles());
    }

  private:
    void find_sheets();
    void separate_sheets();
    void find_crossings();
    void place_vertices();
    std::vector<Triangle> make_triangles();

    const std::vector<Cell>& cells() const { return grid_.cells(); }
    Vec3 place(const Cell& cell, std::span<const Crossing> crossings) const;
    Vec3 project(Vec3 p, const Vec3& low, const Vec3& high) const;
    Crossing crossing_of(const Cell& cell, int edge) const;
    std::array<uint32_t, 4> vertices_around(const Cell& cell, int axis) const;
    void add_quad(Triangle* out, const std::array<uint32_t, 4>& quad) const;

    /// Edges 0, 4 and 8 start at the cell's first corner: this cell keeps what is known of them.
    static int owned_crossings(const Cell& cell) {
        return contour::crosses(cell.inside, 0) + contour::crosses(cell.inside, 4) +
               contour::crosses(cell.inside, 8);
    }

    const ScalarField& f_;
    Grid grid_;
    double step_;
    bool sharp_;
    std::vector<contour::Sheets> sheets_;
    std::vector<uint8_t> flipped_;
    std::vector<uint32_t> first_vertex_;
    std::vector<uint32_t> first_crossing_;
    std::vector<Crossing> crossings_;
    std::vector<Vec3> vertices_;
};

void Contour::find_sheets() {
    sheets_.resize(cells().size());
    flipped_.assign(cells().size(), 0);
    for (size_t c = 0; c < cells().size(); ++c) {
        sheets_[c] = contour::find_sheets(cells()[c].inside, 0);
    }
}

/// Two cells whose common face is crossed four times by the same sheet on either side would share an edge of
/// four quads. Joining that face's crossings the other way cuts both sheets in two (the sheets' boundaries
/// are oriented, so that regrouping two segments of one cycle always gives two cycles); cutting cannot make
/// another face so, hence one pass is enough.
void Contour::separate_sheets() {
    const auto one_sheet = [&](size_t c, int face) {
        const std::array<int, 4> e = contour::face_edges(face);
        return sheets_[c].of_edge[e[0]] == sheets_[c].of_edge[e[1]] &&
               sheets_[c].of_edge[e[0]] == sheets_[c].of_edge[e[2]];
    };
    for (size_t c = 0; c < cells().size(); ++c) {
        for (int face = 1; face < 6; face += 2) {
            if (!contour::is_ambiguous(cells()[c].inside, face) || !one_sheet(c, face)) {
                continue;
            }
            Index3 across = cells()[c].index;
            ++across[face / 2];
            const uint32_t other = grid_.cell_at(across);
            if (one_sheet(other, face - 1)) {
                flipped_[c] |= static_cast<uint8_t>(1 << face);
                flipped_[other] |= static_cast<uint8_t>(1 << (face - 1));
                sheets_[c] = contour::find_sheets(cells()[c].inside, flipped_[c]);
                sheets_[other] = contour::find_sheets(cells()[other].inside, flipped_[other]);
            }
        }
    }
}

void Contour::find_crossings() {
    first_crossing_.resize(cells().size() + 1, 0);
    for (size_t c = 0; c < cells().size(); ++c) {
        first_crossing_[c + 1] = first_crossing_[c] + static_cast<uint32_t>(owned_crossings(cells()[c]));
    }
    crossings_.resize(first_crossing_.back());
    parallel_for(cells().size(), grain, [&](size_t begin, size_t end) {
        for (size_t c = begin; c < end; ++c) {
            const Cell& cell = cells()[c];
            uint32_t number = first_crossing_[c];
            for (int axis = 0; axis < 3; ++axis) {
                if (!contour::crosses(cell.inside, 4 * axis)) {
                    continue;
                }
                Index3 far = cell.index;
                ++far[axis];
                Crossing& crossing = crossings_[number++];
                crossing.point =
                    find_root(f_, grid_.point(cell.index), grid_.sample(cell.index, 0), grid_.point(far),
                              grid_.sample(cell.index, 1 << axis), grid_.cell_size());
                const Vec3 g = gradient(f_, crossing.point, step_);
                const double length = glm::length(g);
                crossing.normal = length > 0 ? g / length : Vec3(0);
            }
        }
    });
}

Crossing Contour::crossing_of(const Cell& cell, int edge) const {
    const int start = contour::edge_start(edge);
    const uint32_t owner = grid_.cell_at(cell.index + Index3(start & 1, start >> 1 & 1, start >> 2 & 1));
    uint32_t number = first_crossing_[owner];
    for (int axis = 0; axis < edge / 4; ++axis) {
        number += contour::crosses(cells()[owner].inside, 4 * axis);
    }
    return crossings_[number];
}

/// Newton's steps to f = 0 along the gradient, held in the cell.
Vec3 Contour::project(Vec3 p, const Vec3& low, const Vec3& high) const {
    for (int i = 0; i < 3; ++i) {
        const double value = f_(p);
        const Vec3 g = gradient(f_, p, step_);
        const double slope2 = glm::dot(g, g);
        if (!(slope2 > 0) || !std::isfinite(value) || std::abs(value) < 1e-12 * grid_.cell_size()) {
            break;
        }
        const Vec3 next = glm::clamp(p - value / slope2 * g, low, high);
        if (!(std::abs(f_(next)) < std::abs(value))) {
            break;
        }
        p = next;
    }
    return p;
}

/// The point nearest to the planes at the crossings (quadratic error function), moved from the crossings'
/// mean only in directions that the planes determine; a cell with one direction has no feature.
Vec3 Contour::place(const Cell& cell, std::span<const Crossing> crossings) const {
    const Vec3 low = grid_.point(cell.index);
    const Vec3 high = grid_.point(cell.index + 1);
    Vec3 mean(0);
    for (const Crossing& c : crossings) {
        mean += c.point / static_cast<double>(crossings.size());
    }
    if (!sharp_) {
        // A cell that the surface only grazes holds no point of it that suits: half a cell of leave.
        const Vec3 leave(0.5 * grid_.cell_size());
        return project(mean, low - leave, high + leave);
    }
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Crossing& c : crossings) {
        const Eigen::Vector3d n(c.normal.x, c.normal.y, c.normal.z);
        normals += n * n.transpose();
        right += n * glm::dot(c.normal, c.point - mean);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals);
    const Eigen::Vector3d& values = solver.eigenvalues(); // ascending
    // A dihedral angle under about 10 degrees within one cell is curvature, not a feature.
    const double least = 0.01 * values[2];
    if (!(values[1] > least)) {
        return project(mean, low, high);
    }
    Eigen::Vector3d move = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
        if (values[k] > least) {
            const Eigen::Vector3d axis = solver.eigenvectors().col(k);
            move += axis * (axis.dot(right) / values[k]);
        }
    }
    return glm::clamp(mean + Vec3(move[0], move[1], move[2]), low, high);
}

void Contour::place_vertices() {
    first_vertex_.resize(cells().size() + 1, 0);
    for (size_t c = 0; c < cells().size(); ++c) {
        first_vertex_[c + 1] = first_vertex_[c] + sheets_[c].count;
    }
    vertices_.resize(first_vertex_.back());
    parallel_for(cells().size(), grain, [&](size_t begin, size_t end) {
        std::vector<Crossing> crossings;
        for (size_t c = begin; c < end; ++c) {
            for (uint8_t sheet = 0; sheet < sheets_[c].count; ++sheet) {
                crossings.clear();
                for (int edge = 0; edge < contour::edge_count; ++edge) {
                    if (sheets_[c].of_edge[edge] == sheet) {
                        crossings.push_back(crossing_of(cells()[c], edge));
                    }
                }
                vertices_[first_vertex_[c] + sheet] = place(cells()[c], crossings);
            }
        }
    });
}

/// The vertices of the four cells around the edge along `axis` from the cell's first corner, turning
/// counterclockwise as seen from the edge's far end.
std::array<uint32_t, 4> Contour::vertices_around(const Cell& cell, int axis) const {
    constexpr std::array<std::array<int, 2>, 4> back{{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
    std::array<uint32_t, 4> result;
    for (size_t k = 0; k < 4; ++k) {
        Index3 index = cell.index;
        index[(axis + 1) % 3] -= back[k][0];
        index[(axis + 2) % 3] -= back[k][1];
        const uint32_t number = grid_.cell_at(index);
        const int edge = 4 * axis + back[k][0] + 2 * back[k][1];
        result[k] = first_vertex_[number] + sheets_[number].of_edge[edge];
    }
    return result;
}

/// Cuts a quad along the diagonal whose middle is nearer to the surface, which keeps sharp edges; along the
/// shorter one where that tells nothing.
void Contour::add_quad(Triangle* out, const std::array<uint32_t, 4>& quad) const {
    const auto point = [&](int k) { return vertices_[quad[k]]; };
    const double off02 = std::abs(f_(0.5 * (point(0) + point(2))));
    const double off13 = std::abs(f_(0.5 * (point(1) + point(3))));
    const bool by_length = !(std::abs(off02 - off13) > 0.02 * grid_.cell_size());
    const bool first =
        by_length ? glm::distance(point(0), point(2)) <= glm::distance(point(1), point(3)) : off02 < off13;
    if (first) {
        out[0] = {quad[0], quad[1], quad[2]};
        out[1] = {quad[0], quad[2], quad[3]};
    } else {
        out[0] = {quad[0], quad[1], quad[3]};
        out[1] = {quad[1], quad[2], quad[3]};
    }
}

std::vector<Triangle> Contour::make_triangles() {
    std::vector<Triangle> triangles(2 * crossings_.size());
    parallel_for(cells().size(), grain, [&](size_t begin, size_t end) {
        for (size_t c = begin; c < end; ++c) {
            Triangle* out = triangles.data() + 2 * static_cast<size_t>(first_crossing_[c]);
            for (int axis = 0; axis < 3; ++axis) {
                if (contour::crosses(cells()[c].inside, 4 * axis)) {
                    std::array<uint32_t, 4> quad = vertices_around(cells()[c], axis);
                    if ((cells()[c].inside & 1) == 0) {
                        std::swap(quad[1], quad[3]);
                    }
                    add_quad(out, quad);
                    out += 2;
                }
            }
        }
    });
    return triangles;
}

} // namespace

Mesh polygonize(const ScalarField& f, const Box& box, const PolygonizeOptions& options) {
    return Contour(f, box, options).run();
}

} // namespace anvil
