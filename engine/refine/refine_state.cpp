#include "engine/refine/adaptive_refinement.h"

namespace anvil {

Vec3 RefineState::place_of(const VertexParents& p) const {
    return between(positions[p.a], positions[p.b], p.place);
}

double RefineState::distance_at(const AnchorField& anchor, const VertexParents& p) const {
    if (anchor.straight_from) {
        return glm::distance(*anchor.straight_from, place_of(p));
    }
    const auto& d = anchor.distances;
    return distance_between(d[p.a], d[p.b], glm::distance(positions[p.a], positions[p.b]), p.place,
                            anchor.kind);
}

uint32_t RefineState::add_vertex(const VertexParents& p) {
    for (HandleField& handle : handles) {
        for (AnchorField& anchor : handle.anchors) {
            anchor.distances.push_back(distance_at(anchor, p));
        }
    }
    positions.push_back(place_of(p));
    parents.push_back(p);
    return static_cast<uint32_t>(positions.size() - 1);
}

void RefineState::move_vertex(uint32_t vertex, double place) {
    VertexParents& p = parents[vertex - (positions.size() - parents.size())];
    p.place = place;
    for (HandleField& handle : handles) {
        for (AnchorField& anchor : handle.anchors) {
            anchor.distances[vertex] = distance_at(anchor, p);
        }
    }
    positions[vertex] = place_of(p);
}

} // namespace anvil
