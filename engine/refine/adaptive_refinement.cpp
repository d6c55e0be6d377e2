#include "engine/refine/adaptive_refinement.h"

#include "engine/refine/creases.h"
#include "engine/refine/flip_edges.h"
#include "engine/refine/longest_first.h"
#include "engine/refine/relax_vertices.h"

#include <numeric>

namespace anvil {

namespace {

// Pieces shorter than this, in radii, are rounding of a vertex that is where it should be.
constexpr double shortest_piece = 1e-7;

// Edges of faces lower than this, over their longest edge, give way to that edge: new edges pile up against
// one that is not split while the faces beside it miss the tolerance, each half as far from it as the one
// before.
constexpr double thinnest = 0.1;

class Refiner {
  public:
    Refiner(std::span<const Triangle> triangles, RefineState state, EdgeCriterion& criterion,
            const RefineOptions& options, Progress& progress)
        : state_(std::move(state)), criterion_(criterion), options_(options), progress_(progress),
          mesh_(triangles, reached_triangles(triangles, state_), state_.positions.size()),
          creases_(state_.handles), first_vertices_(state_.positions.size()) {
        double radius = 0;
        for (const HandleField& handle : state_.handles) {
            radius = std::max(radius, handle.radius);
        }
        shortest_ = std::max(options.min_edge, shortest_piece * radius);
    }

    Refinement run() {
        std::vector<uint32_t> edges(mesh_.edges().size());
        std::iota(edges.begin(), edges.end(), 0U);
        std::vector<uint32_t> faces = all_faces();
        while (!edges.empty()) {
            progress_.report("refine", 1 - 1 / (1.0 + static_cast<double>(report_.rounds)));
            std::vector<EdgeSplit> splits = find_splits(edges);
            if (splits.empty() && !full_) {
                splits = find_face_splits();
            }
            if (splits_everywhere_) {
                faces = all_faces();
            }
            const std::vector<uint32_t> again = let_longest_first(splits, faces);
            if (!keep_within_limit(splits)) {
                splits.clear();
            }
            const size_t first_new_edge = mesh_.edges().size();
            insert(splits);
            faces = mesh_.split(faces, [this](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
                return prefers(a, c, b, d);
            });
            edges.resize(mesh_.edges().size() - first_new_edge);
            std::iota(edges.begin(), edges.end(), static_cast<uint32_t>(first_new_edge));
            if (!splits.empty() && !again.empty()) {
                edges.insert(edges.end(), again.begin(), again.end());
                faces = all_faces(); // those on their other sides were not changed
            }
            edges.erase(
                std::remove_if(edges.begin(), edges.end(), [this](uint32_t e) { return mesh_.is_split(e); }),
                edges.end());
            ++report_.rounds;
        }
        return finished();
    }

  private:
    static std::vector<uint32_t> reached_triangles(std::span<const Triangle> triangles,
                                                   const RefineState& state) {
        std::vector<char> reached(state.positions.size(), 0);
        for (const HandleField& handle : state.handles) {
            for (const AnchorField& anchor : handle.anchors) {
                for (size_t v = 0; v < reached.size(); ++v) {
                    reached[v] |= static_cast<char>(std::isfinite(anchor.distances[v]));
                }
            }
        }
        std::vector<uint32_t> chosen;
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            if (reached[triangles[t][0]] || reached[triangles[t][1]] || reached[triangles[t][2]]) {
                chosen.push_back(t);
            }
        }
        return chosen;
    }

    std::vector<uint32_t> all_faces() const {
        std::vector<uint32_t> faces(mesh_.faces().size());
        std::iota(faces.begin(), faces.end(), 0U);
        return faces;
    }

    EdgeSpan span_of(uint32_t edge) const {
        const EdgeMesh::Edge& e = mesh_.edges()[edge];
        return {e.a, e.b, glm::distance(state_.positions[e.a], state_.positions[e.b])};
    }

    std::vector<EdgeSpan> spans_of(std::span<const uint32_t> edges) const {
        std::vector<EdgeSpan> spans;
        spans.reserve(edges.size());
        for (const uint32_t e : edges) {
            spans.push_back(span_of(e));
        }
        return spans;
    }

    /// Measures the edges, and lets the kinks that matter become creases: then every edge of the mesh that
    /// crosses one is split there, whatever its own error.
    std::vector<EdgeSplit> find_splits(const std::vector<uint32_t>& edges) {
        const std::vector<EdgeSpan> spans = spans_of(edges);
        const auto findings = criterion_.measure(state_, spans, options_.tolerance);
        errors_.resize(mesh_.edges().size(), 0);
        parted_.resize(mesh_.edges().size(), 0);
        std::vector<uint32_t> fresh;
        for (size_t i = 0; i < edges.size(); ++i) {
            errors_[edges[i]] = findings[i].error.error;
            parted_[edges[i]] = findings[i].parted ? 1 : 0;
            if (findings[i].error.error > options_.tolerance && findings[i].error.level != no_index) {
                creases_.raise(findings[i].handle, findings[i].error.level, fresh);
            }
        }
        std::vector<EdgeSplit> splits;
        std::vector<char> taken(mesh_.edges().size(), 0);
        splits_everywhere_ = !fresh.empty();
        if (splits_everywhere_) {
            creases_.label(state_, fresh, labels_);
            add_crossings(whole_edges(), splits, taken);
        } else {
            add_crossings(edges, splits, taken);
        }
        for (size_t i = 0; i < edges.size(); ++i) {
            if (!taken[edges[i]] && findings[i].error.error > options_.tolerance && !findings[i].parted) {
                add_split({edges[i], findings[i].error.place, findings[i].error.error, no_index},
                          spans[i].length, splits);
            }
        }
        return splits;
    }

    /// `faces` become all of them where splits spread. @return edges that are to be looked at again.
    std::vector<uint32_t> let_longest_first(std::vector<EdgeSplit>& splits, std::vector<uint32_t>& faces) {
        parted_.resize(mesh_.edges().size(), 0);
        GivenWay given = put_longest_first(mesh_, faces, state_.positions, thinnest, parted_, splits);
        for (const uint32_t edge : given.blocked) {
            parted_[edge] = 1;
        }
        if (!given.later.empty() && !splits_everywhere_) {
            faces = all_faces();
        }
        return std::move(given.later);
    }

    /// Edges are within the tolerance; faces that are not are split at their longest edge.
    std::vector<EdgeSplit> find_face_splits() {
        std::vector<Triangle> corners;
        corners.reserve(mesh_.faces().size());
        for (const EdgeMesh::Face& face : mesh_.faces()) {
            corners.push_back(face.corners);
        }
        const auto found = criterion_.measure_faces(state_, corners, options_.tolerance);
        std::vector<EdgeSplit> splits;
        std::vector<char> taken(mesh_.edges().size(), 0);
        face_error_ = 0;
        for (size_t f = 0; f < found.size(); ++f) {
            const EdgeMesh::Face& face = mesh_.faces()[f];
            if (found[f].parted || is_parted(face)) {
                continue;
            }
            face_error_ = std::max(face_error_, found[f].error);
            const auto [edge, length] = longest_edge(face);
            if (found[f].error > options_.tolerance && edge != no_index && !taken[edge]) {
                taken[edge] = 1;
                add_split({edge, 0.5, found[f].error, no_index}, length, splits);
            }
        }
        splits_everywhere_ = true; // the faces on the other side were not changed last
        return splits;
    }

    bool is_parted(const EdgeMesh::Face& face) const {
        return std::any_of(face.edges.begin(), face.edges.end(),
                           [this](uint32_t e) { return e != no_index && parted_[e] != 0; });
    }

    std::pair<uint32_t, double> longest_edge(const EdgeMesh::Face& face) const {
        std::pair<uint32_t, double> longest{no_index, 0};
        for (const uint32_t edge : face.edges) {
            const double length = edge == no_index ? 0 : span_of(edge).length;
            if (length > longest.second) {
                longest = {edge, length};
            }
        }
        return longest;
    }

    std::vector<uint32_t> whole_edges() const {
        std::vector<uint32_t> edges;
        for (uint32_t e = 0; e < mesh_.edges().size(); ++e) {
            if (!mesh_.is_split(e)) {
                edges.push_back(e);
            }
        }
        return edges;
    }

    void add_crossings(const std::vector<uint32_t>& edges, std::vector<EdgeSplit>& splits,
                       std::vector<char>& taken) {
        if (creases_.empty()) {
            return;
        }
        const std::vector<EdgeSpan> spans = spans_of(edges);
        const auto crossings = creases_.cross(state_, spans);
        for (size_t i = 0; i < edges.size(); ++i) {
            if (crossings[i].crease == no_index) {
                continue;
            }
            taken[edges[i]] = 1;
            const uint32_t crease = crossings[i].is_on ? crossings[i].crease : no_index;
            add_split({edges[i], crossings[i].place, errors_[edges[i]], crease}, spans[i].length, splits);
        }
    }

    /// Moves the place so that no piece is too short; drops the split where both would be.
    void add_split(EdgeSplit split, double length, std::vector<EdgeSplit>& splits) {
        const double margin = shortest_ / length;
        if (margin >= 0.5) {
            limited_ = true;
            return;
        }
        const double place = std::clamp(split.place, margin, 1 - margin);
        if (place != split.place) {
            split.crease = no_index;
            split.place = place;
        }
        splits.push_back(split);
    }

    /// Leaves the worst ones if not all can be made; false if none can.
    bool keep_within_limit(std::vector<EdgeSplit>& splits) {
        const size_t room = options_.max_vertices - std::min(options_.max_vertices, state_.positions.size());
        if (splits.size() > room) {
            full_ = true;
            std::sort(splits.begin(), splits.end(), [](const EdgeSplit& x, const EdgeSplit& y) {
                return x.error != y.error ? x.error > y.error : x.edge < y.edge;
            });
            splits.resize(room);
        }
        return !splits.empty();
    }

    void insert(const std::vector<EdgeSplit>& splits) {
        for (const EdgeSplit& split : splits) {
            const EdgeMesh::Edge edge = mesh_.edges()[split.edge];
            const uint32_t vertex = state_.add_vertex({edge.a, edge.b, split.place});
            mesh_.mark(split.edge, vertex);
            labels_.resize(state_.positions.size(), no_index);
            labels_[vertex] = split.crease;
        }
        labels_.resize(state_.positions.size(), no_index);
    }

    /// Whether a - b is a better diagonal than c - d: one that joins two vertices of a crease, or the shorter
    /// one.
    bool prefers(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
        const bool crease = labels_[a] != no_index && labels_[a] == labels_[b];
        const bool other_crease = labels_[c] != no_index && labels_[c] == labels_[d];
        if (crease != other_crease) {
            return crease;
        }
        const auto& p = state_.positions;
        return glm::distance(p[a], p[b]) < glm::distance(p[c], p[d]);
    }

    Refinement finished() {
        errors_.resize(mesh_.edges().size(), 0);
        parted_.resize(mesh_.edges().size(), 0);
        for (uint32_t e = 0; e < mesh_.edges().size(); ++e) {
            if (!mesh_.is_split(e) && parted_[e]) {
                ++report_.parted_edges;
                report_.parted_error = std::max(report_.parted_error, errors_[e]);
            } else if (!mesh_.is_split(e)) {
                report_.max_error = std::max(report_.max_error, errors_[e]);
            }
        }
        report_.max_error = std::max(report_.max_error, face_error_);
        report_.added = state_.positions.size() - first_vertices_;
        report_.stopped_by = full_                      ? RefineStop::max_vertices
                             : limited_                 ? RefineStop::min_edge
                             : report_.parted_edges > 0 ? RefineStop::parting
                                                        : RefineStop::tolerance;
        std::vector<EdgeMesh::Face> faces = mesh_.faces();
        if (options_.flip) {
            report_.max_error = std::max(report_.max_error, flip(faces));
        }
        if (options_.relax) {
            report_.max_error = std::max(report_.max_error, relax(faces));
        }
        progress_.report("refine", 1);
        return {std::move(state_), std::move(faces), report_};
    }

    double flip(std::vector<EdgeMesh::Face>& faces) {
        FlipRules rules;
        rules.is_fixed = [this](uint32_t a, uint32_t b) {
            return labels_[a] != no_index && labels_[a] == labels_[b];
        };
        rules.errors = [this](std::span<const EdgeSpan> edges) {
            std::vector<double> errors;
            for (const auto& finding : criterion_.measure(state_, edges, options_.tolerance)) {
                errors.push_back(finding.error.error);
            }
            return errors;
        };
        rules.tolerance = options_.tolerance;
        return flip_edges(faces, state_.positions, rules);
    }

    double relax(const std::vector<EdgeMesh::Face>& faces) {
        RelaxRules rules{std::vector<char>(labels_.size(), 0), options_.tolerance, &criterion_};
        for (size_t v = 0; v < labels_.size(); ++v) {
            rules.fixed[v] = labels_[v] != no_index ? 1 : 0;
        }
        return relax_vertices(state_, faces, rules);
    }

    RefineState state_;
    EdgeCriterion& criterion_;
    const RefineOptions& options_;
    Progress& progress_;
    EdgeMesh mesh_;
    Creases creases_;
    size_t first_vertices_;
    double shortest_ = 0;
    RefineReport report_;
    std::vector<double> errors_;   ///< per edge, as last measured
    std::vector<char> parted_;     ///< per edge: not 0 where no split brings the error down
    std::vector<uint32_t> labels_; ///< per vertex: the crease that it was put on
    double face_error_ = 0;        ///< inside faces, as last measured
    bool splits_everywhere_ = false;
    bool limited_ = false;
    bool full_ = false;
};

bool comes_within(const Triangle& t, std::span<const Vec3> positions, const Vec3& centre, double radius) {
    const Vec3 low = glm::min(positions[t[0]], glm::min(positions[t[1]], positions[t[2]]));
    const Vec3 high = glm::max(positions[t[0]], glm::max(positions[t[1]], positions[t[2]]));
    return glm::distance(glm::clamp(centre, low, high), centre) <= radius;
}

} // namespace

std::vector<EdgeCriterion::FaceFinding> EdgeCriterion::measure_faces(const RefineState& /*state*/,
                                                                     std::span<const Triangle> /*faces*/,
                                                                     double /*enough*/) {
    return {};
}

void EdgeCriterion::vertices_moved(const RefineState& /*state*/, std::span<const uint32_t> /*vertices*/) {}

Refinement refine(std::span<const Triangle> triangles, RefineState state, EdgeCriterion& criterion,
                  const RefineOptions& options, Progress& progress) {
    return Refiner(triangles, std::move(state), criterion, options, progress).run();
}

double needed_reach(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                    std::span<const Vec3> sources, double radius) {
    double longest = 0;
    for (const Triangle& t : triangles) {
        for (const Vec3& source : sources) {
            if (comes_within(t, positions, source, radius)) {
                for (int i = 0; i < 3; ++i) {
                    longest =
                        std::max(longest, glm::distance(positions[t[i]], positions[t[i == 2 ? 0 : i + 1]]));
                }
                break;
            }
        }
    }
    return radius + 2 * longest;
}

} // namespace anvil
