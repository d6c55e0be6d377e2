#include "engine/core/parallel_for.h"
#include "engine/refine/adaptive_refinement.h"

namespace anvil {

namespace {

class ShapeCriterion : public EdgeCriterion {
  public:
    std::vector<Finding> measure(const RefineState& state, std::span<const EdgeSpan> edges,
                                 double enough) override {
        std::vector<Finding> findings(edges.size());
        parallel_for(edges.size(), 256, [&](size_t begin, size_t end) {
            std::vector<EdgeMeasure> measures(state.handles.begin(), state.handles.end());
            for (size_t i = begin; i < end; ++i) {
                for (uint32_t h = 0; h < measures.size(); ++h) {
                    const EdgeError error = measures[h].worst(edges[i], enough);
                    if (error.error > findings[i].error.error) {
                        findings[i] = {error, h};
                    }
                }
            }
        });
        return findings;
    }
};

} // namespace

std::unique_ptr<EdgeCriterion> make_shape_criterion() {
    return std::make_unique<ShapeCriterion>();
}

} // namespace anvil
