#include "engine/refine/space_criterion.h"

namespace anvil {

namespace {

class WorseOfBoth : public EdgeCriterion {
  public:
    WorseOfBoth(std::unique_ptr<EdgeCriterion> first, double first_tolerance,
                std::unique_ptr<EdgeCriterion> second, double second_tolerance)
        : first_(std::move(first)), second_(std::move(second)), first_tolerance_(first_tolerance),
          second_tolerance_(second_tolerance) {}

    std::vector<Finding> measure(const RefineState& state, std::span<const EdgeSpan> edges,
                                 double enough) override {
        auto findings = first_->measure(state, edges, enough * first_tolerance_);
        const auto others = second_->measure(state, edges, enough * second_tolerance_);
        for (size_t i = 0; i < findings.size(); ++i) {
            findings[i].error.error /= first_tolerance_;
            const double other = others[i].error.error / second_tolerance_;
            findings[i].parted = others[i].parted && findings[i].error.error <= 1;
            if (other > findings[i].error.error) {
                findings[i] = others[i];
                findings[i].error.error = other;
            }
        }
        return findings;
    }

    std::vector<FaceFinding> measure_faces(const RefineState& state, std::span<const Triangle> faces,
                                           double enough) override {
        auto findings = second_->measure_faces(state, faces, enough * second_tolerance_);
        for (FaceFinding& finding : findings) {
            finding.error /= second_tolerance_;
        }
        return findings;
    }

    void vertices_moved(const RefineState& state, std::span<const uint32_t> vertices) override {
        first_->vertices_moved(state, vertices);
        second_->vertices_moved(state, vertices);
    }

  private:
    std::unique_ptr<EdgeCriterion> first_, second_;
    double first_tolerance_, second_tolerance_;
};

} // namespace

std::unique_ptr<EdgeCriterion> make_both_criteria(double shape_tolerance, MovePoints move,
                                                  double space_tolerance) {
    return std::make_unique<WorseOfBoth>(make_shape_criterion(), shape_tolerance,
                                         make_space_criterion(std::move(move), space_tolerance),
                                         space_tolerance);
}

} // namespace anvil
