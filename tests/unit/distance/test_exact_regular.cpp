// Regular meshes, where rays run along edges, through vertices and into each other: what decides is rounding.
#include "engine/mesh/sample_shapes.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

constexpr DistanceMethod exact = DistanceMethod::exact;

// Every window is laid out anew in each triangle that it crosses: some 100 times a few eps, of distances up
// to 40 here.
constexpr double roundings = 1e-12;

/// Turned in space, coordinates rounded to multiples of `step`: flat parts are flat to that only, with
/// saddles and peaks of that size.
Mesh turned(Mesh mesh, double step) {
    const double a = 0.7, b = 1.1;
    for (Vec3& p : mesh.positions) {
        p = {std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
        p = {p.x, std::cos(b) * p.y - std::sin(b) * p.z, std::sin(b) * p.y + std::cos(b) * p.z};
        for (int k = 0; k < 3 && step > 0; ++k) {
            p[k] = step * std::round(p[k] / step);
        }
    }
    return mesh;
}

/// n x n squares of side 1 / n, all diagonals the same way.
Mesh grid(uint32_t n) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i <= n; ++i) {
            positions.emplace_back(i / double(n), j / double(n), 0);
            if (i < n && j < n) {
                const uint32_t a = j * (n + 1) + i;
                triangles.push_back({a, a + 1, a + n + 2});
                triangles.push_back({a, a + n + 2, a + n + 1});
            }
        }
    }
    return from_triangles(std::move(positions), std::move(triangles));
}

std::vector<uint32_t> some_sources(const Mesh& mesh, uint32_t step) {
    std::vector<bool> used(mesh.vertex_count());
    for (const Triangle& t : mesh.triangles) {
        used[t[0]] = used[t[1]] = used[t[2]] = true;
    }
    std::vector<uint32_t> sources;
    for (uint32_t v = 0; v < mesh.vertex_count(); v += step) {
        if (used[v]) {
            sources.push_back(v);
        }
    }
    return sources;
}

std::vector<std::vector<double>> fields(const Mesh& mesh, const std::vector<uint32_t>& sources) {
    const GeodesicSolver solver(mesh, mesh.positions);
    std::vector<std::vector<double>> all;
    for (const uint32_t v : sources) {
        const std::vector<SurfacePoint> source = {vertex_source(v)};
        all.push_back(solver.solve(source, infinity, exact).dense(mesh.vertex_count()));
    }
    return all;
}

struct Broken {
    double symmetry = 0;
    double triangle = 0; ///< the most by which a way over a third vertex is shorter
};

/// Infinite where a vertex is reached from one side only.
Broken metric_faults(const std::vector<std::vector<double>>& all, const std::vector<uint32_t>& sources) {
    Broken broken;
    for (size_t a = 0; a < sources.size(); ++a) {
        for (size_t b = 0; b < sources.size(); ++b) {
            const double there = all[a][sources[b]], back = all[b][sources[a]];
            broken.symmetry =
                std::max(broken.symmetry, std::isfinite(there) ? std::abs(there - back) : infinity);
            for (size_t v = 0; v < all[a].size(); ++v) {
                if (std::isfinite(all[a][v]) || std::isfinite(all[b][v])) {
                    broken.triangle = std::max(broken.triangle, all[a][v] - there - all[b][v]);
                }
            }
        }
    }
    return broken;
}

struct Named {
    const char* name;
    Mesh mesh;
};

std::vector<Named> regular_meshes() {
    return {
        {"torus", make_sample("torus", 700)},         {"grid", grid(20)},
        {"icosphere", make_sample("icosphere", 642)}, {"cube", make_sample("cube", 600)},
        {"cylinder", make_sample("cylinder", 500)},   {"strip", folded_strip(plane(40, 8, 40, 8, 0), 40)}};
}

} // namespace

TEST_CASE("exact distances on regular meshes are symmetric and keep the triangle inequality") {
    for (const Named& it : regular_meshes()) {
        for (const double step : {0.0, 1e-12, 1e-9, 1e-7}) {
            const Mesh mesh = turned(it.mesh, step);
            const std::vector<uint32_t> sources = some_sources(mesh, 23);
            const Broken broken = metric_faults(fields(mesh, sources), sources);
            INFO(it.name << " rounded to " << step);
            CHECK(broken.symmetry < roundings);
            CHECK(broken.triangle < roundings);
        }
    }
}

TEST_CASE("exact distances on regular meshes do not depend on the numbering") {
    for (const Named& it : regular_meshes()) {
        const auto n = static_cast<uint32_t>(it.mesh.vertex_count());
        uint32_t factor = 97;
        while (std::gcd(factor, n) != 1) {
            ++factor;
        }
        const auto renumbered = [&](uint32_t v) {
            return static_cast<uint32_t>((uint64_t(v) * factor + 31) % n);
        };
        std::vector<Vec3> positions(n);
        for (uint32_t v = 0; v < n; ++v) {
            positions[renumbered(v)] = it.mesh.positions[v];
        }
        std::vector<Triangle> triangles;
        for (const Triangle& t : it.mesh.triangles) {
            triangles.insert(triangles.begin(), {renumbered(t[1]), renumbered(t[2]), renumbered(t[0])});
        }
        const std::vector<uint32_t> sources = some_sources(it.mesh, 131);
        std::vector<uint32_t> others;
        for (const uint32_t v : sources) {
            others.push_back(renumbered(v));
        }
        const std::vector<std::vector<double>> all = fields(it.mesh, sources);
        const std::vector<std::vector<double>> again =
            fields(from_triangles(std::move(positions), std::move(triangles)), others);
        double worst = 0;
        for (size_t a = 0; a < all.size(); ++a) {
            for (uint32_t v = 0; v < n; ++v) {
                const double one = all[a][v], two = again[a][renumbered(v)];
                worst = std::max(worst, std::isfinite(one) || std::isfinite(two) ? std::abs(one - two) : 0.0);
            }
        }
        INFO(it.name);
        CHECK(worst < roundings);
    }
}

TEST_CASE("exact distances on a plane are the straight ones however its coordinates are rounded") {
    for (const double step : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
        const Mesh mesh = turned(grid(40), step);
        const std::vector<uint32_t> sources = some_sources(mesh, 211);
        const std::vector<std::vector<double>> all = fields(mesh, sources);
        double worst = 0;
        for (size_t a = 0; a < all.size(); ++a) {
            for (size_t v = 0; v < mesh.vertex_count(); ++v) {
                const double error =
                    std::abs(all[a][v] - glm::length(mesh.positions[v] - mesh.positions[sources[a]]));
                worst = error >= 0 ? std::max(worst, error) : infinity;
            }
        }
        INFO("rounded to " << step);
        // A way of 40 cells over humps of the height of a step gains the square of its slope.
        CHECK(worst < roundings + std::pow(40 * step, 2));
    }
}

TEST_CASE("exact distances differ by no more than the edge on regular meshes") {
    for (const char* shape : {"torus", "cube", "icosphere", "cylinder"}) {
        const Mesh mesh = make_sample(shape, 10000);
        std::vector<uint32_t> sources;
        for (size_t place = 0; place < 6; ++place) {
            sources.push_back(mesh.triangles[place * mesh.triangles.size() / 6][0]);
        }
        for (const std::vector<double>& found : fields(mesh, sources)) {
            double worst = -infinity;
            for (const Triangle& t : mesh.triangles) {
                for (int k = 0; k < 3; ++k) {
                    const uint32_t a = t[k], b = t[(k + 1) % 3];
                    const double beyond =
                        std::abs(found[a] - found[b]) - glm::length(mesh.positions[a] - mesh.positions[b]);
                    worst = std::isfinite(beyond) ? std::max(worst, beyond) : infinity;
                }
            }
            INFO(shape);
            CHECK(worst < roundings);
        }
    }
}
