#include "engine/forge/kept_marches.h"

#include "engine/core/parallel_for.h"
#include "engine/distance/anchor_blend.h"

namespace anvil {

namespace {

// Workspaces of a march by both methods, and what all of them may take.
constexpr size_t bytes_a_vertex = 210;
constexpr size_t most_bytes = size_t{512} << 20;

bool is_same(const SurfacePoint& a, const SurfacePoint& b) {
    return a.triangle == b.triangle && a.barycentric == b.barycentric && a.vertex == b.vertex;
}
bool is_same(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& p, const auto& q) { return is_same(p, q); });
}
bool is_same(uint32_t a, uint32_t b) {
    return a == b;
}

template <typename Item>
bool begins_with(const std::vector<Item>& all, const std::vector<Item>& first) {
    return first.size() <= all.size() &&
           std::equal(first.begin(), first.end(), all.begin(),
                      [](const auto& a, const auto& b) { return is_same(a, b); });
}

template <typename Item>
std::vector<Item> rest(const std::vector<Item>& all, const std::vector<Item>& first) {
    return {all.begin() + static_cast<std::ptrdiff_t>(first.size()), all.end()};
}

/// What `all` has beyond `first`, if it has all of that.
std::optional<DistanceSources> beyond(const DistanceSources& all, const DistanceSources& first) {
    if (!begins_with(all.points, first.points) || !begins_with(all.polylines, first.polylines) ||
        !begins_with(all.triangles, first.triangles)) {
        return std::nullopt;
    }
    return DistanceSources{rest(all.points, first.points), rest(all.polylines, first.polylines),
                           rest(all.triangles, first.triangles)};
}

bool is_empty(const DistanceSources& sources) {
    return sources.points.empty() && sources.polylines.empty() && sources.triangles.empty();
}

} // namespace

std::vector<KeptMarches::Part> KeptMarches::parts_of(std::span<const DistanceQuery> queries) const {
    std::vector<Part> parts;
    for (size_t q = 0; q < queries.size(); ++q) {
        if (queries[q].metric == Metric::geodesic) {
            AnchorFields single =
                fields_of_anchors(queries[q].anchors, queries[q].radius, queries[q].blend_width);
            for (DistanceSources& sources : single.sources) {
                parts.push_back({q, std::move(sources), single.reach});
            }
        }
    }
    return parts;
}

/// One march per part, taken out of `kept_` where one is of use; `further`: the sources that it lacks.
std::vector<KeptMarches::Kept> KeptMarches::marches_for(std::span<const DistanceQuery> queries,
                                                        std::span<const Part> parts,
                                                        std::vector<DistanceSources>& further) {
    std::vector<std::optional<Kept>> found(parts.size());
    further.resize(parts.size());
    // Those that have all of a part's sources are not spent on others that they have some of.
    for (const bool complete : {true, false}) {
        for (size_t i = 0; i < parts.size(); ++i) {
            const DistanceQuery& query = queries[parts[i].query];
            for (auto kept = kept_.begin(); kept != kept_.end() && !found[i]; ++kept) {
                std::optional<DistanceSources> lacking = beyond(parts[i].sources, kept->sources);
                if (kept->method == query.method && kept->rounds == query.smooth_rounds && lacking &&
                    (!complete || is_empty(*lacking))) {
                    further[i] = std::move(*lacking);
                    ++(complete ? work_.continued : work_.extended);
                    found[i].emplace(std::move(*kept));
                    kept_.erase(kept);
                    break;
                }
            }
        }
    }
    kept_.clear();
    std::vector<Kept> marches;
    for (size_t i = 0; i < parts.size(); ++i) {
        const DistanceQuery& query = queries[parts[i].query];
        if (!found[i]) {
            further[i] = parts[i].sources;
            ++work_.begun;
            found[i].emplace(Kept{query.method,
                                  query.smooth_rounds,
                                  {},
                                  surface_.solver(query.smooth_rounds).march(query.method)});
        }
        found[i]->sources = parts[i].sources;
        marches.push_back(std::move(*found[i]));
    }
    return marches;
}

std::vector<DistanceField> KeptMarches::distances(std::span<const DistanceQuery> queries) {
    const std::vector<Part> parts = parts_of(queries);
    if (parts.size() * surface_.vertex_count() > most_bytes / bytes_a_vertex) {
        kept_.clear();
        work_.begun += parts.size();
        return surface_.distances(queries);
    }
    std::vector<DistanceSources> further;
    std::vector<Kept> marches = marches_for(queries, parts, further);
    std::vector<DistanceField> single(parts.size());
    std::vector<size_t> steps(parts.size());
    parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            GeodesicMarch& march = marches[i].march;
            const size_t before = march.steps();
            if (!is_empty(further[i])) {
                march.add(further[i]);
            }
            march.grow(parts[i].reach);
            steps[i] = march.steps() - before;
            single[i] = march.field();
        }
    });
    kept_ = std::move(marches);
    std::vector<DistanceField> fields(queries.size());
    for (size_t q = 0, part = 0; q < queries.size(); ++q) {
        if (queries[q].metric == Metric::euclidean) {
            fields[q] = std::move(surface_.distances(queries.subspan(q, 1))[0]);
            continue;
        }
        std::vector<DistanceField> own;
        for (; part < parts.size() && parts[part].query == q; ++part) {
            work_.steps += steps[part];
            own.push_back(std::move(single[part]));
        }
        fields[q] = blended(std::move(own), queries[q].radius, queries[q].blend_width);
    }
    return fields;
}

} // namespace anvil
