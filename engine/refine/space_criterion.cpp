#include "engine/refine/space_criterion.h"

#include "engine/refine/edge_error.h"

namespace anvil {

namespace {

constexpr std::array<double, 3> first_places{0.25, 0.5, 0.75};
constexpr std::array<double, 4> further_places{0.125, 0.375, 0.625, 0.875};
constexpr std::array<double, 7> closing_steps{0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.0039, 0.00195};
// An edge that misses this little of the tolerance at three places hides no miss of it elsewhere.
constexpr double worth_a_second_look = 0.25;
constexpr size_t batch = size_t{1} << 18;
// A part of an edge is torn that the edit makes longer than the tolerance, and so many times longer than
// before.
constexpr double torn = 20;
// Edges are cut no nearer to their ends than this share, except at kinks: slivers cost more than some
// vertices.
constexpr double off_centre = 0.3;

/// A place on an edge of the batch, and the kink that lies there.
struct Sample {
    size_t edge;
    double place;
    uint32_t handle = no_index;
    uint32_t level = no_index;
};

/// What linear interpolation misses at a place of an edge.
struct Miss {
    double place;
    Vec3 by;
};

/// A part of an edge, and what its ends miss.
struct Gap {
    Miss from, to;

    double width() const { return glm::distance(from.by, to.by); }
    double length() const { return to.place - from.place; }
    double middle() const { return 0.5 * (from.place + to.place); }
};

/// The part between two places that follow each other whose ends differ most.
Gap widest_gap(std::vector<Miss> misses) {
    misses.push_back({0, Vec3(0)});
    misses.push_back({1, Vec3(0)});
    std::sort(misses.begin(), misses.end(), [](const Miss& x, const Miss& y) { return x.place < y.place; });
    Gap widest{misses[0], misses[1]};
    for (size_t i = 2; i < misses.size(); ++i) {
        const Gap gap{misses[i - 1], misses[i]};
        widest = gap.width() > widest.width() ? gap : widest;
    }
    return widest;
}

class SpaceCriterion : public EdgeCriterion {
  public:
    SpaceCriterion(MovePoints move, double parting_length)
        : move_(std::move(move)), parting_length_(parting_length) {}

    std::vector<Finding> measure(const RefineState& state, std::span<const EdgeSpan> edges,
                                 double enough) override {
        follow_vertices(state);
        std::vector<Finding> findings(edges.size());
        for (size_t begin = 0; begin < edges.size(); begin += batch) {
            const size_t count = std::min(batch, edges.size() - begin);
            measure_batch(state, edges.subspan(begin, count), enough, &findings[begin]);
        }
        return findings;
    }

    std::vector<FaceFinding> measure_faces(const RefineState& state, std::span<const Triangle> faces,
                                           double enough) override {
        follow_vertices(state);
        std::vector<FaceFinding> findings(faces.size());
        for (size_t begin = 0; begin < faces.size(); begin += batch) {
            const size_t count = std::min(batch, faces.size() - begin);
            measure_face_batch(state, faces.subspan(begin, count), &findings[begin]);
        }
        for (size_t f = 0; f < faces.size(); ++f) {
            findings[f].parted = is_too_short(longest_side(state, faces[f]), enough);
        }
        return findings;
    }

    void vertices_moved(const RefineState& state, std::span<const uint32_t> vertices) override {
        follow_vertices(state);
        Points points;
        for (const uint32_t v : vertices) {
            add_vertex(state, v, points);
        }
        const std::vector<Vec3> ends = moved(points, state.handles.size());
        for (size_t i = 0; i < ends.size(); ++i) {
            ends_[vertices[i]] = ends[i];
        }
    }

  private:
    /// Points to move, with the distances of every handle, point by point.
    struct Points {
        std::vector<Vec3> places;
        std::vector<double> distances;
    };

    std::vector<Vec3> moved(const Points& points, size_t handles) const {
        const size_t n = points.places.size();
        std::vector<double> by_handle(handles * n);
        for (size_t i = 0; i < n; ++i) {
            for (size_t h = 0; h < handles; ++h) {
                by_handle[h * n + i] = points.distances[i * handles + h];
            }
        }
        return n == 0 ? std::vector<Vec3>{} : move_(points.places, by_handle);
    }

    static void add_vertex(const RefineState& state, uint32_t v, Points& points) {
        points.places.push_back(state.positions[v]);
        for (const HandleField& handle : state.handles) {
            points.distances.push_back(handle.distance(v));
        }
    }

    /// Where the vertices that are new since the last call end.
    void follow_vertices(const RefineState& state) {
        Points points;
        for (auto v = static_cast<uint32_t>(ends_.size()); v < state.positions.size(); ++v) {
            add_vertex(state, v, points);
        }
        const std::vector<Vec3> ends = moved(points, state.handles.size());
        ends_.insert(ends_.end(), ends.begin(), ends.end());
    }

    static bool is_reached(std::vector<EdgeMeasure>& measures, const EdgeSpan& edge) {
        return std::any_of(measures.begin(), measures.end(),
                           [&](EdgeMeasure& measure) { return measure.reaches(edge); });
    }

    void measure_batch(const RefineState& state, std::span<const EdgeSpan> edges, double enough,
                       Finding* findings) {
        std::vector<EdgeMeasure> measures(state.handles.begin(), state.handles.end());
        std::vector<Sample> samples;
        for (size_t e = 0; e < edges.size(); ++e) {
            if (!is_reached(measures, edges[e])) {
                continue;
            }
            for (const double place : first_places) {
                samples.push_back({e, place});
            }
            add_kinks(measures, edges[e], e, samples);
        }
        std::vector<std::vector<Miss>> misses(edges.size());
        look(state, measures, edges, samples, misses, findings);
        std::vector<Sample> further;
        for (size_t e = 0; e < edges.size(); ++e) {
            const double error = findings[e].error.error;
            for (const double place : further_places) {
                if (error > worth_a_second_look * enough && error <= enough) {
                    further.push_back({e, place});
                }
            }
        }
        look(state, measures, edges, further, misses, findings);
        for (const double step : closing_steps) {
            close_in(state, measures, edges, enough, step, misses, findings);
        }
        find_partings(state, measures, edges, enough, misses, findings);
        for (size_t e = 0; e < edges.size(); ++e) {
            EdgeError& error = findings[e].error;
            if (error.level == no_index) {
                error.place = std::clamp(error.place, off_centre, 1 - off_centre);
            }
        }
    }

    /// Short edges that miss more than the tolerance: whether a part of them is torn. A map that is not
    /// brings the ends of a part together as it is halved.
    void find_partings(const RefineState& state, std::vector<EdgeMeasure>& measures,
                       std::span<const EdgeSpan> edges, double enough,
                       const std::vector<std::vector<Miss>>& misses, Finding* findings) const {
        std::vector<std::pair<size_t, Gap>> gaps;
        for (size_t e = 0; e < edges.size(); ++e) {
            if (findings[e].error.error > enough && edges[e].length <= parting_length_) {
                findings[e].parted = is_too_short(edges[e].length, enough);
                gaps.emplace_back(e, widest_gap(misses[e]));
            }
        }
        while (!gaps.empty()) {
            std::vector<Sample> samples;
            std::vector<std::pair<size_t, Gap>> open;
            for (const auto& [edge, gap] : gaps) {
                if (findings[edge].parted || gap.width() <= enough) {
                    continue;
                }
                if (is_too_short(gap.length() * edges[edge].length, enough)) {
                    findings[edge].parted = true;
                } else {
                    open.emplace_back(edge, gap);
                    samples.push_back({edge, gap.middle()});
                }
            }
            gaps = std::move(open);
            narrow(misses_at(state, measures, edges, samples), gaps);
        }
    }

    static bool is_too_short(double length, double enough) { return length * torn <= enough; }

    static void narrow(const std::vector<Vec3>& at_middle, std::vector<std::pair<size_t, Gap>>& gaps) {
        for (size_t i = 0; i < gaps.size(); ++i) {
            const Gap& gap = gaps[i].second;
            const Gap first{gap.from, {gap.middle(), at_middle[i]}};
            const Gap second{first.to, gap.to};
            gaps[i].second = second.width() > first.width() ? second : first;
        }
    }

    /// On edges that will be split: both sides of the worst place so far. A vertex beside the line where the
    /// surface meets an occluder calls for another one.
    void close_in(const RefineState& state, std::vector<EdgeMeasure>& measures,
                  std::span<const EdgeSpan> edges, double enough, double step,
                  std::vector<std::vector<Miss>>& misses, Finding* findings) const {
        std::vector<Sample> samples;
        for (size_t e = 0; e < edges.size(); ++e) {
            const EdgeError& error = findings[e].error;
            if (error.error > enough && error.level == no_index) {
                for (const double place : {error.place - step, error.place + step}) {
                    if (place > 0 && place < 1) {
                        samples.push_back({e, place});
                    }
                }
            }
        }
        look(state, measures, edges, samples, misses, findings);
    }

    static void add_kinks(std::vector<EdgeMeasure>& measures, const EdgeSpan& edge, size_t number,
                          std::vector<Sample>& samples) {
        for (uint32_t h = 0; h < measures.size(); ++h) {
            for (uint32_t level = 0; level < measures[h].levels().size(); ++level) {
                if (!measures[h].levels()[level].kink) {
                    continue;
                }
                for (const double place : measures[h].crossings(edge, level)) {
                    samples.push_back({number, place, h, level});
                }
            }
        }
    }

    /// What linear interpolation misses at the samples.
    std::vector<Vec3> misses_at(const RefineState& state, std::vector<EdgeMeasure>& measures,
                                std::span<const EdgeSpan> edges, const std::vector<Sample>& samples) const {
        Points points;
        for (const Sample& sample : samples) {
            const EdgeSpan& edge = edges[sample.edge];
            points.places.push_back(between(state.positions[edge.a], state.positions[edge.b], sample.place));
            for (EdgeMeasure& measure : measures) {
                points.distances.push_back(measure.distance(edge, sample.place));
            }
        }
        std::vector<Vec3> misses = moved(points, measures.size());
        for (size_t i = 0; i < samples.size(); ++i) {
            const EdgeSpan& edge = edges[samples[i].edge];
            misses[i] -= between(ends_[edge.a], ends_[edge.b], samples[i].place);
        }
        return misses;
    }

    /// Moves the samples and adds what they miss. The error of an edge is the diameter of its misses and 0:
    /// so is that of its parts no larger (see EdgeError).
    void look(const RefineState& state, std::vector<EdgeMeasure>& measures, std::span<const EdgeSpan> edges,
              const std::vector<Sample>& samples, std::vector<std::vector<Miss>>& misses,
              Finding* findings) const {
        const std::vector<Vec3> found = misses_at(state, measures, edges, samples);
        for (size_t i = 0; i < samples.size(); ++i) {
            const Sample& sample = samples[i];
            const Vec3& miss = found[i];
            std::vector<Miss>& others = misses[sample.edge];
            Finding& finding = findings[sample.edge];
            double largest = 0;
            for (const Miss& other : others) {
                finding.error.error = std::max(finding.error.error, glm::distance(miss, other.by));
                largest = std::max(largest, glm::length(other.by));
            }
            others.push_back({sample.place, miss});
            finding.error.error = std::max(finding.error.error, glm::length(miss));
            if (glm::length(miss) > largest) {
                finding.error.place = sample.place;
                finding.error.level = sample.level;
                finding.handle = sample.handle == no_index ? 0 : sample.handle;
            }
        }
    }

    /// Four inner points of each face; on the way from a corner to the opposite edge their distances are
    /// those that vertices put there would get.
    void measure_face_batch(const RefineState& state, std::span<const Triangle> faces,
                            FaceFinding* findings) const {
        constexpr std::array<std::array<double, 2>, 4> inner{
            {{2.0 / 3, 0.5}, {1.0 / 3, 0.5}, {5.0 / 6, 0.2}, {5.0 / 6, 0.8}}};
        Points points;
        for (const Triangle& t : faces) {
            for (const auto& [down, across] : inner) {
                add_inner_point(state, t, down, across, points);
            }
        }
        const std::vector<Vec3> ends = moved(points, state.handles.size());
        for (size_t i = 0; i < ends.size(); ++i) {
            const Triangle& t = faces[i / inner.size()];
            const auto& [down, across] = inner[i % inner.size()];
            const Vec3 straight = between(ends_[t[0]], between(ends_[t[1]], ends_[t[2]], across), down);
            double& error = findings[i / inner.size()].error;
            error = std::max(error, glm::distance(ends[i], straight));
        }
    }

    static double longest_side(const RefineState& state, const Triangle& t) {
        const auto& p = state.positions;
        return std::max({glm::distance(p[t[0]], p[t[1]]), glm::distance(p[t[1]], p[t[2]]),
                         glm::distance(p[t[2]], p[t[0]])});
    }

    static void add_inner_point(const RefineState& state, const Triangle& t, double down, double across,
                                Points& points) {
        const auto& p = state.positions;
        const Vec3 opposite = between(p[t[1]], p[t[2]], across);
        points.places.push_back(between(p[t[0]], opposite, down));
        const double width = glm::distance(p[t[1]], p[t[2]]);
        const double height = glm::distance(p[t[0]], opposite);
        std::vector<double> each;
        for (const HandleField& handle : state.handles) {
            each.clear();
            for (const AnchorField& anchor : handle.anchors) {
                const auto& d = anchor.distances;
                const double beyond = distance_between(d[t[1]], d[t[2]], width, across, anchor.kind);
                each.push_back(distance_between(d[t[0]], beyond, height, down, anchor.kind));
            }
            points.distances.push_back(handle.blended(each));
        }
    }

    MovePoints move_;
    double parting_length_;
    std::vector<Vec3> ends_; ///< of the vertices
};

} // namespace

std::unique_ptr<EdgeCriterion> make_space_criterion(MovePoints move, double parting_length) {
    return std::make_unique<SpaceCriterion>(std::move(move), parting_length);
}

} // namespace anvil
