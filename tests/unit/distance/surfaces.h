// Small surfaces whose distances have a closed form.
#pragma once

#include "engine/distance/distance.h"
#include "engine/mesh/mesh.h"

#include <map>
#include <random>

namespace anvil::surfaces {

inline Mesh from_triangles(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const Triangle& t : triangles) {
        mesh.add_polygon(t);
    }
    mesh.triangles = std::move(triangles);
    return mesh;
}

inline SurfacePoint vertex_source(uint32_t vertex) {
    return {no_index, Vec3(0.0), vertex};
}

/// columns x rows quads over the rectangle [0,width] x [0,height] of the plane z = 0, diagonals at random,
/// inner vertices moved by up to `jitter` of a cell.
inline Mesh plane(int columns, int rows, double width, double height, double jitter, unsigned seed = 1) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return random() / 4294967296.0; };
    std::vector<Vec3> positions;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const bool inner = i > 0 && j > 0 && i < columns && j < rows;
            const double u = i + (inner ? jitter * (2 * uniform() - 1) : 0);
            const double v = j + (inner ? jitter * (2 * uniform() - 1) : 0);
            positions.emplace_back(width * u / columns, height * v / rows, 0);
        }
    }
    std::vector<Triangle> triangles;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const auto a = static_cast<uint32_t>(j * (columns + 1) + i);
            const uint32_t b = a + 1, c = a + columns + 2, d = a + columns + 1;
            if (uniform() < 0.5) {
                triangles.push_back({a, b, c});
                triangles.push_back({a, c, d});
            } else {
                triangles.push_back({a, b, d});
                triangles.push_back({b, c, d});
            }
        }
    }
    return from_triangles(std::move(positions), std::move(triangles));
}

/// The plane above with x rolled or folded along the given profile, which must keep lengths between the
/// columns: `profile(i)` is the place of column i in (x, z).
template <typename Profile>
Mesh bent(Mesh flat, int columns, const Profile& profile) {
    for (size_t v = 0; v < flat.positions.size(); ++v) {
        const std::pair<double, double> place = profile(static_cast<int>(v % (columns + 1)));
        flat.positions[v] = {place.first, flat.positions[v].y, place.second};
    }
    return flat;
}

/// Icosahedron on the unit sphere, each triangle split in four `times` times.
inline Mesh sphere(int times) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3> p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vec3& v : p) {
        v = glm::normalize(v);
    }
    std::vector<Triangle> t = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                               {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                               {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                               {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int n = 0; n < times; ++n) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [place, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(p.size()));
            if (fresh) {
                p.push_back(glm::normalize(p[a] + p[b]));
            }
            return place->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : t) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        t = std::move(finer);
    }
    return from_triangles(std::move(p), std::move(t));
}

/// Straight distances to the nearest source.
inline Vec3 place(const Mesh& mesh, const SurfacePoint& point);
inline std::vector<double> straight(const Mesh& mesh, const std::vector<SurfacePoint>& sources) {
    std::vector<double> distances;
    for (const Vec3& p : mesh.positions) {
        double nearest = infinity;
        for (const SurfacePoint& source : sources) {
            nearest = std::min(nearest, glm::length(p - place(mesh, source)));
        }
        distances.push_back(nearest);
    }
    return distances;
}

/// A strip of steps of length 1, folded by a right angle at each of `columns` columns.
inline Mesh folded_strip(const Mesh& flat, int columns) {
    return bent(flat, columns, [](int i) {
        const std::array<std::pair<int, int>, 4> turn = {{{0, 0}, {1, 0}, {1, 1}, {2, 1}}};
        return std::pair<double, double>(2 * (i / 4) + turn[i % 4].first, turn[i % 4].second);
    });
}

/// A closed prism over the unit circle, its rows `height` / rows apart; vertex (column, row) has the index
/// row * (columns + 1) + column; those of the last column are isolated.
inline Mesh prism(int columns, int rows, double height) {
    const double side = 2 * std::sin(M_PI / columns);
    Mesh mesh = bent(plane(columns, rows, columns * side, height, 0), columns, [&](int i) {
        const double angle = 2 * M_PI * (i % columns) / columns;
        return std::pair<double, double>(std::cos(angle), std::sin(angle));
    });
    for (Triangle& t : mesh.triangles) {
        for (uint32_t& v : t) {
            v = v % (columns + 1) == static_cast<uint32_t>(columns) ? v - columns : v;
        }
    }
    return mesh;
}

/// Three square sheets of n x n unit cells on one edge x = 0: any two of them unfold to a flat rectangle.
struct Sheets {
    Mesh mesh;
    int n;
    uint32_t index(int sheet, int i, int j) const {
        return static_cast<uint32_t>(i == 0 ? j : (n + 1) + (sheet * n + i - 1) * (n + 1) + j);
    }
};
inline Sheets three_sheets(int n) {
    Sheets sheets{{}, n};
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (int j = 0; j <= n; ++j) {
        positions.emplace_back(0, j, 0);
    }
    for (int sheet = 0; sheet < 3; ++sheet) {
        const double angle = 2.1 * sheet;
        for (int i = 1; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                positions.emplace_back(i * std::cos(angle), j, i * std::sin(angle));
            }
        }
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const auto v = [&](int a, int b) { return sheets.index(sheet, a, b); };
                triangles.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
                triangles.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
            }
        }
    }
    sheets.mesh = from_triangles(std::move(positions), std::move(triangles));
    return sheets;
}

/// Smooth bumps on a square, with many saddles.
inline Mesh bumps(int cells, double height, unsigned seed = 5) {
    Mesh mesh = plane(cells, cells, 1, 1, 0.2, seed);
    for (Vec3& p : mesh.positions) {
        p.z = height * std::sin(9 * p.x + 1) * std::cos(8 * p.y);
    }
    return mesh;
}

inline std::vector<double> solve(const Mesh& mesh, std::vector<SurfacePoint> sources,
                                 double radius = infinity,
                                 DistanceMethod method = DistanceMethod::approximate) {
    const GeodesicSolver solver(mesh, mesh.positions);
    return solver.solve(sources, radius, method).dense(mesh.vertex_count());
}

inline Vec3 place(const Mesh& mesh, const SurfacePoint& point) {
    if (point.triangle == no_index) {
        return mesh.positions[point.vertex];
    }
    const Triangle& t = mesh.triangles[point.triangle];
    return point.barycentric[0] * mesh.positions[t[0]] + point.barycentric[1] * mesh.positions[t[1]] +
           point.barycentric[2] * mesh.positions[t[2]];
}

/// Largest |a - b| / max(b, floor); infinite where only one of them is.
inline double worst_relative(const std::vector<double>& a, const std::vector<double>& b, double floor) {
    double worst = a.size() == b.size() ? 0 : infinity;
    for (size_t i = 0; i < a.size() && i < b.size(); ++i) {
        if (std::isinf(a[i]) && std::isinf(b[i])) {
            continue;
        }
        const double error = std::abs(a[i] - b[i]) / std::max(b[i], floor);
        worst = error >= 0 ? std::max(worst, error) : infinity;
    }
    return worst;
}

} // namespace anvil::surfaces
