// Errors of the approximate distances, mesh by mesh, against exact ones.
//   bench_distance_errors [--cache FOLDER] [--worst N] [MESH ...]
// MESH is a file, or SAMPLE:VERTICES, then @X,Y,Z to stretch it and ^N to cut every triangle into four N
// times. Without a MESH: the sample shapes below, and the files of ANVIL_TEST_MESHES and ANVIL_TEST_EXACT
// where set. Relative errors of vertices farther than one mean edge. Constants of the method were chosen on
// the meshes marked "chosen"; the others were only looked at afterwards. --cache keeps exact fields between
// runs.
#include "engine/core/log.h"
#include "engine/distance/distance.h"
#include "engine/distance/fan_table.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

using namespace anvil;

namespace {

constexpr double mean_aim = 8e-4, max_aim = 1e-2;

struct Entry {
    std::string name;
    bool chosen;
};

const std::vector<Entry> own_meshes = {
    {"sphere:3000", true},       {"icosphere:2562", false},      {"torus:5000", true},
    {"cube:3000", false},        {"cylinder:4000", true},        {"plane:4000", false},
    {"hand:8000", true},         {"bust:8000", false},           {"sphere:3000@1,4,1", true},
    {"torus:5000@1,1,3", false}, {"hand:8000@1,5,1", true},      {"bust:8000@4,1,1", false},
    {"icosphere:642^2", true},   {"hand:1500^1@1,1,4", false},   {"cube:600^2", true},
    {"bust:1000^2", false},      {"cylinder:800@1,0.2,3", true}, {"icosphere:10242@1,1,0.2", false},
    {"hand:1500@1,1,4", false},  {"cube:500@3,0.5,1", false},
};

const std::vector<Entry> real_meshes = {
    {"armadillo.ply", true},
    {"bunny.obj", false},
    {"bunny_hr.obj@1,1,5", true},
    {"bunny_hr.obj", false},
    {"fandisk.obj^1", true},
    {"hand_closed.obj@4,1,1", false},
    {"hand_closed_loop2.ply", true},
    {"hand_lowres_open.obj", false},
    {"human_woman.obj", true},
    {"makehuman_body.obj", false},
    {"sphere.obj", true},
    {"spot_control_mesh.obj", false},
    {"suzanne.obj", true},
    {"teapot.obj", false},
    {"torus.off", true},
    {"nefertiti.obj", false},
};

/// Three sources each, by the files that come with them.
const std::vector<Entry> exact_meshes = {
    {"hand", true},      {"fandisk", false},   {"wingnut", true},   {"bunny", false},
    {"armadillo", true}, {"nefertiti", false}, {"rob_human", true},
};

Mesh subdivided(const Mesh& mesh) {
    Mesh finer;
    finer.positions = mesh.positions;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(finer.positions.size()));
        if (is_new) {
            finer.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
        }
        return found->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            finer.triangles.push_back(t);
        }
    }
    return finer;
}

/// `name` without what follows `mark`, which comes back.
std::string cut_at(std::string& name, char mark) {
    const size_t place = name.rfind(mark);
    if (place == std::string::npos) {
        return "";
    }
    const std::string rest = name.substr(place + 1);
    name.resize(place);
    return rest;
}

Mesh mesh_named(std::string name) {
    const std::string stretch = cut_at(name, '@'), times = cut_at(name, '^');
    const size_t colon = name.rfind(':');
    Log log;
    Mesh mesh = colon == std::string::npos
                    ? read_mesh(name, log)
                    : make_sample(name.substr(0, colon), std::strtoul(name.c_str() + colon + 1, nullptr, 10));
    for (unsigned long i = 0; i < std::strtoul(times.c_str(), nullptr, 10); ++i) {
        mesh = subdivided(mesh);
    }
    if (!stretch.empty()) {
        const char* at = stretch.c_str();
        char* end = nullptr;
        Vec3 by;
        for (int k = 0; k < 3; ++k, at = end + 1) {
            by[k] = std::strtod(at, &end);
        }
        for (Vec3& p : mesh.positions) {
            p *= by;
        }
    }
    return mesh;
}

double mean_edge(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            sum += glm::length(mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]);
        }
    }
    return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

std::vector<double> read_field(const std::filesystem::path& path, size_t count) {
    std::ifstream in(path, std::ios::binary);
    std::vector<double> field(count);
    in.read(reinterpret_cast<char*>(field.data()), static_cast<std::streamsize>(8 * count));
    return in ? field : std::vector<double>();
}

struct Case {
    std::string name;
    Mesh mesh;
    std::vector<uint32_t> sources;
    std::filesystem::path fields; ///< fields + SOURCE.f64 are kept; empty: nowhere
};

std::vector<double> exact_field(const Case& c, const GeodesicSolver& solver, uint32_t source) {
    const std::filesystem::path path = c.fields.string() + std::to_string(source) + ".f64";
    std::vector<double> field;
    if (!c.fields.empty()) {
        field = read_field(path, c.mesh.vertex_count());
    }
    if (field.empty()) {
        const std::vector<SurfacePoint> from = {{no_index, Vec3(0.0), source}};
        field = solver.solve(from, infinity, DistanceMethod::exact).dense(c.mesh.vertex_count());
        if (!c.fields.empty()) {
            std::ofstream(path, std::ios::binary)
                .write(reinterpret_cast<const char*>(field.data()),
                       static_cast<std::streamsize>(8 * field.size()));
        }
    }
    return field;
}

/// What is special about the surface at a vertex that a mesh misses its aim at.
std::string reason(const Mesh& mesh, uint32_t vertex) {
    const TriangleGraph graph = make_triangle_graph(
        mesh.triangles, mesh.positions, number_as_given(mesh.triangles.size(), mesh.vertex_count()));
    const auto is_one_fan = [&](uint32_t v) {
        return fan_shape(graph, v, graph.sides_leaving(v).front()).kind != FanShape::Kind::tangled;
    };
    bool one_fan = is_one_fan(vertex), smooth = true;
    for (const uint32_t side : graph.sides_leaving(vertex)) {
        for (const uint32_t near : {graph.to(side), graph.apex(side)}) {
            one_fan = one_fan && is_one_fan(near);
            double total = 0;
            for (const uint32_t corner : graph.sides_leaving(near)) {
                total += corner_angle(graph, corner);
            }
            smooth = smooth && std::abs(total - 2 * M_PI) < 0.3;
        }
    }
    return !one_fan ? "beside a vertex whose faces are not one fan"
           : smooth ? "far from anything sharp"
                    : "beside a vertex more than 0.3 rad from flat: too coarse";
}

struct Worst {
    double error, edges;
    uint32_t source, vertex;
};

struct Totals {
    size_t meshes = 0, mean_reached = 0, max_reached = 0;
};

void tell(const Case& c, bool chosen, size_t most_worst, Totals& totals) {
    const GeodesicSolver solver(c.mesh, c.mesh.positions);
    const double edge = mean_edge(c.mesh);
    double sum = 0;
    size_t count = 0, above = 0, unreached = 0;
    std::vector<Worst> worst;
    for (const uint32_t source : c.sources) {
        const std::vector<double> truth = exact_field(c, solver, source);
        const std::vector<SurfacePoint> from = {{no_index, Vec3(0.0), source}};
        const std::vector<double> found =
            solver.solve(from, infinity, DistanceMethod::approximate).dense(c.mesh.vertex_count());
        for (uint32_t v = 0; v < truth.size(); ++v) {
            const bool reachable = truth[v] < 1e50; // files say 1e100
            unreached += reachable != std::isfinite(found[v]) ? 1 : 0;
            if (reachable && std::isfinite(found[v]) && truth[v] > edge) {
                const double error = (found[v] - truth[v]) / truth[v];
                sum += std::abs(error);
                above += std::abs(error) > max_aim ? 1 : 0;
                ++count;
                worst.push_back({error, truth[v] / edge, source, v});
            }
        }
    }
    const size_t kept = std::min(std::max<size_t>(most_worst, 1), worst.size());
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(kept), worst.end(),
                      [](const Worst& a, const Worst& b) { return std::abs(a.error) > std::abs(b.error); });
    const double mean = sum / static_cast<double>(count), most = std::abs(worst.front().error);
    std::printf("%-26s %-7s %7zu %2zu %8.4f %8.3f %6zu %8zu %7.1f %s%s%s\n", c.name.c_str(),
                chosen ? "chosen" : "", c.mesh.vertex_count(), c.sources.size(), 100 * mean, 100 * most,
                above, count, worst.front().edges, mean <= mean_aim ? "" : "MEAN ",
                most <= max_aim ? "" : "MAX ", unreached == 0 ? "" : "UNREACHED");
    if (most > max_aim) {
        std::printf("      %.3f %% beyond the aim, %s\n", 100 * (most - max_aim),
                    reason(c.mesh, worst.front().vertex).c_str());
    }
    for (size_t i = 0; i < (most_worst > 0 ? kept : 0); ++i) {
        std::printf("      %+8.3f %% at vertex %u, %.1f edges from %u\n", 100 * worst[i].error,
                    worst[i].vertex, worst[i].edges, worst[i].source);
    }
    std::fflush(stdout);
    ++totals.meshes;
    totals.mean_reached += mean <= mean_aim ? 1 : 0;
    totals.max_reached += most <= max_aim ? 1 : 0;
}

std::vector<uint32_t> spread_sources(const Mesh& mesh) {
    std::vector<uint32_t> sources;
    for (size_t i = 0; i < 4; ++i) {
        sources.push_back(mesh.triangles[i * mesh.triangles.size() / 4][0]);
    }
    return sources;
}

std::string file_name(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name + "_";
}

} // namespace

int main(int argc, char** argv) {
    std::vector<Entry> entries;
    std::filesystem::path cache;
    size_t most_worst = 0;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--cache" && i + 1 < argc) {
            cache = argv[++i];
        } else if (argument == "--worst" && i + 1 < argc) {
            most_worst = std::strtoul(argv[++i], nullptr, 10);
        } else {
            entries.push_back({argument, false});
        }
    }
    const char *meshes = std::getenv("ANVIL_TEST_MESHES"), *exact = std::getenv("ANVIL_TEST_EXACT");
    const bool all = entries.empty();
    if (all) {
        entries = own_meshes;
        for (const Entry& entry : meshes != nullptr ? real_meshes : std::vector<Entry>()) {
            entries.push_back({meshes + ("/" + entry.name), entry.chosen});
        }
    }
    Totals totals;
    std::printf("%-26s %-7s %7s %2s %8s %8s %6s %8s %7s\n", "mesh", "", "vertices", "n", "mean %", "max %",
                ">1 %", "of", "edges");
    try {
        for (const Entry& entry : entries) {
            Case c{std::filesystem::path(entry.name).filename().string(), mesh_named(entry.name), {}, {}};
            c.sources = spread_sources(c.mesh);
            c.fields = cache.empty() ? cache : cache / file_name(entry.name);
            tell(c, entry.chosen, most_worst, totals);
        }
        for (const Entry& entry : all&& exact != nullptr ? exact_meshes : std::vector<Entry>()) {
            const std::string base = exact + ("/" + entry.name);
            Case c{"exact/" + entry.name, mesh_named(base + ".obj"), {}, base + "_"};
            std::ifstream in(base + ".src");
            for (uint32_t source = 0; in >> source;) {
                c.sources.push_back(source);
            }
            tell(c, entry.chosen, most_worst, totals);
        }
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "bench_distance_errors: %s\n", problem.what());
        return 2;
    }
    std::printf("mean reached on %zu, maximum on %zu of %zu meshes\n", totals.mean_reached,
                totals.max_reached, totals.meshes);
    return 0;
}
