#include "app/viewer/health_check.h"

#include "engine/core/number_text.h"

namespace anvil {

namespace {

bool is_ready(const std::future<MeshHealth>& future) {
    return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::string counted(size_t count, const char* what) {
    return std::to_string(count) + " " + what;
}

} // namespace

void HealthCheck::start(std::shared_ptr<const Mesh> mesh) {
    std::erase_if(running_, is_ready); // one that runs would be waited for
    result_.reset();
    running_.push_back(std::async(std::launch::async, [mesh = std::move(mesh), done = done_] {
        MeshHealth health = examine(*mesh);
        done();
        return health;
    }));
}

const MeshHealth* HealthCheck::result() {
    if (!result_ && !running_.empty() && is_ready(running_.back())) {
        result_ = std::make_unique<const MeshHealth>(running_.back().get());
        running_.pop_back();
    }
    return result_.get();
}

std::vector<HealthAdvice> advice_on(const MeshHealth& health) {
    std::vector<HealthAdvice> advice;
    const auto add = [&](const Finding& finding, const char* what, const char* place, const char* mend) {
        if (finding.count > 0) {
            advice.push_back({counted(finding.count, what) + " (first: " + place + " " +
                                  std::to_string(finding.first) + ")",
                              mend});
        }
    };
    add(health.non_manifold_edges, "edges with three faces or more", "vertex",
        "distances there are exact and slower; split the surface there for sharper results");
    add(health.inconsistent_edges, "edges between faces of opposite orientation", "vertex",
        "make all faces look outwards in the program that made the mesh");
    add(health.duplicate_positions, "vertices at the position of another", "vertex",
        "edits stop at the gap between them: weld them (STL is welded as it is read)");
    add(health.bowtie_vertices, "vertices where parts touch in a point", "vertex",
        "edits hardly pass them: join the parts by faces, or split them");
    add(health.degenerate_triangles, "triangles without area", "triangle",
        "they have no normal and shade badly: collapse their shortest edge");
    add(health.folded_polygons, "polygons far from flat", "face",
        "the fold of their triangles is a guess: split them yourself");
    add(health.isolated_vertices, "vertices without a face", "vertex", "they stay where they are");
    if (health.components > 1) {
        advice.push_back(
            {counted(health.components, "separate parts"),
             "distances along the surface end with the part: use straight ones (D) to move several"});
    }
    if (health.volume && *health.volume < 0) {
        advice.push_back(
            {"all faces look inwards", "turn them around; normals and N point inwards until then"});
    }
    if (!health.closed) {
        advice.push_back(
            {"the surface is open: " + counted(health.boundary_edges, "edges at its border in ") +
                 counted(health.boundary_loops, "loops"),
             "volumes are not known, and it is no good occluder"});
    }
    if (health.needles > health.triangles / 20) {
        advice.push_back({counted(health.needles, "triangles with an angle below 5 degrees"),
                          "refinement with flip and relax keeps angles larger"});
    }
    if (far_from_origin(health.box)) {
        advice.push_back(
            {"the mesh is far from the origin for its size",
             "it is drawn and computed relative to its own middle; write it in double precision"});
    }
    return advice;
}

} // namespace anvil
