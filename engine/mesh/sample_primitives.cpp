#include "engine/mesh/sample_primitives.h"

#include "engine/mesh/sample_revolved.h"
#include "engine/mesh/triangle_mesh.h"

#include <map>
#include <numbers>

namespace anvil::sample {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double row_height = 0.8660254037844386; // of equilateral triangles, in edges

bool within(size_t count, size_t wish, double tolerance) {
    return std::abs(static_cast<double>(count) - static_cast<double>(wish)) <=
           tolerance * static_cast<double>(wish);
}

/// Edge of the equilateral triangles that cover `area` with so many vertices.
double edge_for(double area, size_t vertices) {
    return std::sqrt(area / (row_height * static_cast<double>(vertices)));
}

size_t rounded(double x, size_t least) {
    return std::max(least, static_cast<size_t>(std::lround(x)));
}

/// Quadrilaterals to be cut into triangles; when the grid cannot meet a count, some get a vertex in their
/// middle.
struct QuadSurface {
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 4>> quads;

    Mesh triangulated(size_t vertices) {
        const size_t missing = within(positions.size(), vertices, 0.05) || positions.size() > vertices
                                   ? 0
                                   : vertices - positions.size();
        std::vector<Triangle> triangles;
        triangles.reserve(2 * (quads.size() + missing));
        for (size_t q = 0; q < quads.size(); ++q) {
            const auto& c = quads[q];
            if ((q + 1) * missing / quads.size() == q * missing / quads.size()) {
                triangles.insert(triangles.end(), {Triangle{c[0], c[1], c[2]}, Triangle{c[0], c[2], c[3]}});
                continue;
            }
            const auto middle = static_cast<uint32_t>(positions.size());
            positions.push_back((positions[c[0]] + positions[c[1]] + positions[c[2]] + positions[c[3]]) /
                                4.0);
            for (size_t k = 0; k < 4; ++k) {
                triangles.push_back({c[k], c[(k + 1) % 4], middle});
            }
        }
        return mesh_of_triangles(std::move(positions), std::move(triangles));
    }
};

Mesh tetrahedron() {
    const double s = 1 / std::sqrt(3.0);
    return mesh_of_triangles({{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}},
                             {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

size_t cube_count(const std::array<size_t, 3>& n) {
    return 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]) + 2;
}

} // namespace

Mesh sphere(size_t vertices) {
    const size_t frequency = rounded(std::sqrt((static_cast<double>(vertices) - 2) / 10), 1);
    if (within(10 * frequency * frequency + 2, vertices, 0.1)) {
        return geodesic_sphere(frequency);
    }
    if (vertices == 4) {
        return tetrahedron();
    }
    const double edge = edge_for(4 * pi, vertices);
    const size_t bands = std::min(rounded(pi / (row_height * edge), 2), (vertices - 2) / 3 + 1);
    std::vector<Ring> rings;
    for (size_t r = 0; r <= bands; ++r) {
        const double angle = pi * static_cast<double>(r) / static_cast<double>(bands);
        const bool pole = r == 0 || r == bands;
        rings.push_back({pole ? 0 : std::sin(angle), -std::cos(angle)});
    }
    return revolve(rings, vertices);
}

Mesh plane(size_t vertices) {
    const auto columns = static_cast<uint32_t>(std::sqrt(static_cast<double>(vertices)));
    const auto rows = static_cast<uint32_t>(vertices / columns);
    QuadSurface surface;
    for (uint32_t r = 0; r < rows; ++r) {
        for (uint32_t c = 0; c < columns; ++c) {
            surface.positions.emplace_back(double(c) / (columns - 1) - 0.5, double(r) / (rows - 1) - 0.5, 0);
            if (r > 0 && c > 0) {
                const uint32_t v = r * columns + c;
                surface.quads.push_back({v - columns - 1, v - columns, v, v - 1});
            }
        }
    }
    return surface.triangulated(vertices);
}

Mesh cylinder(size_t vertices) {
    double edge = edge_for(2 * pi * cylinder_radius * (cylinder_radius + 2 * cylinder_half_height), vertices);
    size_t cap = 0;
    size_t side = 0;
    do {
        cap = rounded(cylinder_radius / (row_height * edge), 1);
        side = rounded(2 * cylinder_half_height / (row_height * edge), 1);
        edge *= 1.05;
    } while (2 + 3 * (2 * cap + side - 1) > vertices);
    std::vector<Ring> rings;
    for (size_t r = 0; r < cap; ++r) {
        rings.push_back(
            {cylinder_radius * static_cast<double>(r) / static_cast<double>(cap), -cylinder_half_height});
    }
    for (size_t r = 0; r <= side; ++r) {
        const double along = static_cast<double>(r) / static_cast<double>(side);
        rings.push_back({cylinder_radius, (2 * along - 1) * cylinder_half_height});
    }
    for (size_t r = cap; r-- > 0;) {
        rings.push_back(
            {cylinder_radius * static_cast<double>(r) / static_cast<double>(cap), cylinder_half_height});
    }
    return revolve(rings, vertices);
}

Mesh torus(size_t vertices) {
    const double wish = static_cast<double>(vertices);
    const double squarest = std::sqrt(wish * torus_tube / torus_radius);
    uint32_t tube = 3;
    double best = infinity;
    for (auto n = static_cast<uint32_t>(std::max(3.0, squarest - 4)); n <= squarest + 4; ++n) {
        const double around = static_cast<double>(rounded(wish / n, 3));
        const double cost = 10 * std::abs(around * n / wish - 1) +
                            std::abs(std::log(n * torus_radius / (around * torus_tube)));
        if (cost < best) {
            best = cost;
            tube = n;
        }
    }
    const auto around = static_cast<uint32_t>(rounded(wish / tube, 3));
    QuadSurface surface;
    for (uint32_t a = 0; a < around; ++a) {
        const double u = 2 * pi * a / around;
        for (uint32_t t = 0; t < tube; ++t) {
            const double v = 2 * pi * t / tube;
            const double radius = torus_radius + torus_tube * std::cos(v);
            surface.positions.emplace_back(radius * std::sin(u), torus_tube * std::sin(v),
                                           radius * std::cos(u));
            const uint32_t next_a = (a + 1) % around * tube;
            const uint32_t next_t = (t + 1) % tube;
            surface.quads.push_back({a * tube + t, next_a + t, next_a + next_t, a * tube + next_t});
        }
    }
    return surface.triangulated(0);
}

Mesh cube(size_t vertices) {
    const size_t least = rounded(std::floor(std::sqrt((static_cast<double>(vertices) - 2) / 6)), 1);
    std::array<size_t, 3> cells{least, least, least};
    for (size_t axis = 0; axis < 3; ++axis) {
        ++cells[axis];
        if (cube_count(cells) > vertices) {
            --cells[axis];
            break;
        }
    }
    QuadSurface surface;
    std::map<std::array<size_t, 3>, uint32_t> on_edges;
    const auto vertex = [&](const std::array<size_t, 3>& index) {
        const auto add = [&] {
            Vec3 p;
            for (size_t k = 0; k < 3; ++k) {
                p[static_cast<int>(k)] = static_cast<double>(index[k]) / static_cast<double>(cells[k]) - 0.5;
            }
            surface.positions.push_back(p);
            return static_cast<uint32_t>(surface.positions.size() - 1);
        };
        size_t walls = 0;
        for (size_t k = 0; k < 3; ++k) {
            walls += index[k] == 0 || index[k] == cells[k];
        }
        if (walls < 2) {
            return add();
        }
        const auto found = on_edges.find(index);
        return found != on_edges.end() ? found->second : on_edges.emplace(index, add()).first->second;
    };
    for (size_t axis = 0; axis < 3; ++axis) {
        const size_t u = (axis + 1) % 3;
        const size_t v = (axis + 2) % 3;
        for (const size_t wall : {size_t{0}, cells[axis]}) {
            std::vector<uint32_t> grid;
            for (size_t j = 0; j <= cells[v]; ++j) {
                for (size_t i = 0; i <= cells[u]; ++i) {
                    std::array<size_t, 3> index{};
                    index[axis] = wall;
                    index[u] = i;
                    index[v] = j;
                    grid.push_back(vertex(index));
                }
            }
            const size_t row = cells[u] + 1;
            for (size_t j = 0; j < cells[v]; ++j) {
                for (size_t i = 0; i < cells[u]; ++i) {
                    const size_t k = j * row + i;
                    std::array<uint32_t, 4> quad{grid[k], grid[k + 1], grid[k + row + 1], grid[k + row]};
                    if (wall == 0) {
                        std::swap(quad[1], quad[3]);
                    }
                    surface.quads.push_back(quad);
                }
            }
        }
    }
    return surface.triangulated(vertices);
}

} // namespace anvil::sample
