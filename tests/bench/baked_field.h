// Baked fields for benchmarks, and what they are off at random points.
#pragma once

#include "engine/core/parallel_for.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/occluder_set.h"

#include <ctime>
#include <random>

namespace anvil::bench {

/// Processor time of this process, all threads: other work on the machine disturbs it least.
inline double seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A field as the kernels see it.
struct Baked {
    OccluderSet set;
    double voxel = 0;
    double error = 0;
    double seconds = 0;
    double megabytes = 0;
};

/// A solid in a space whose origin is at `by` of its own.
class MovedSolid final : public ExactDistance {
  public:
    MovedSolid(std::shared_ptr<const ExactDistance> solid, const Vec3& by)
        : solid_(std::move(solid)), by_(by) {}
    SignedDistance at(const Vec3& p) const override { return solid_->at(p + by_); }
    Box bounds() const override { return solid_->bounds(); } // the grid stays

  private:
    std::shared_ptr<const ExactDistance> solid_;
    Vec3 by_;
};

/// `by`: where the field's own origin is to lie.
inline Baked baked(const std::shared_ptr<const ExactDistance>& exact, FieldKind kind, uint32_t resolution,
                   InfluenceKind influence, const Vec3& by = Vec3(0)) {
    Progress progress;
    const double start = seconds();
    const OccluderModel model = sampled_model(exact, {kind, resolution}, progress);
    Baked result;
    result.seconds = seconds() - start;
    result.voxel = model.field ? model.field->voxel : model.volumes.front()->voxel;
    result.error = model.field ? model.field->error : model.volumes.front()->error;
    result.megabytes =
        static_cast<double>(model.field ? model.field->bytes()
                                        : model.volumes.front()->texels.size() * sizeof(float)) /
        1e6;
    const double diagonal = exact->bounds().diagonal();
    Transform pose;
    pose.translate = by;
    add_occluder(result.set, model, "tool", pose, {influence, 0.9, {}, {}, 0},
                 {Vec3(0), diagonal, 0.5 * diagonal});
    return result;
}

struct Sample {
    Vec3 point;
    SignedDistance truth;
};

/// Anywhere in the field's box, as far as it reaches beyond the solid's; no farther from the surface than
/// `band`.
inline std::vector<Sample> random_samples(const ExactDistance& exact, double voxel, size_t count,
                                          double band) {
    const Box box = exact.bounds();
    const Vec3 margin(3 * voxel);
    std::mt19937_64 random(7);
    std::vector<Sample> samples;
    while (samples.size() < count) {
        std::vector<Sample> more(100000);
        for (Sample& s : more) {
            for (int i = 0; i < 3; ++i) {
                s.point[i] = std::uniform_real_distribution<double>(box.low[i] - margin[i],
                                                                    box.high[i] + margin[i])(random);
            }
        }
        parallel_for(more.size(), 256, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                more[i].truth = exact.at(more[i].point);
            }
        });
        std::erase_if(more, [&](const Sample& s) { return !(std::abs(s.truth.distance) <= band); });
        samples.insert(samples.end(), more.begin(), more.end());
    }
    samples.resize(count);
    return samples;
}

struct Errors {
    double rms = 0;
    double worst = 0;
    size_t beyond = 0;     ///< more than adaptive_tolerance()
    size_t worse = 0;      ///< and more than a dense field there, and what is rounded in storage
    size_t wrong_sign = 0; ///< where |distance| > voxel / 4
    double normal_rms = 0; ///< length of the difference
};

inline kernel::f64::OccluderKernel kernel_of(const OccluderSet& set) {
    return {set.segments.data(), set.nodes.data(), set.occluders.data(), set.volumes.data(), set.words()};
}

/// `dense`: a field of the same voxels, or none.
inline Errors errors_of(const Baked& field, const Baked* dense, const std::vector<Sample>& samples) {
    kernel::f64::OccluderKernel kernel = kernel_of(field.set);
    Errors errors;
    for (const Sample& s : samples) {
        const auto probe = kernel.occluder_probe(0, s.point);
        const double error = std::abs(probe.distance - s.truth.distance) / field.voxel;
        const double distance = std::abs(s.truth.distance) / field.voxel;
        if (dense != nullptr && error > adaptive_tolerance(distance)) {
            const double other = kernel_of(dense->set).occluder_probe(0, s.point).distance;
            // Half a unit of 1/2047 of at most twice the largest distance in a brick of 4 voxels.
            const double rounded = (distance + 7) / kernel::f64::BRICK_DISTANCES;
            errors.worse += error > std::abs(other - s.truth.distance) / field.voxel + rounded ? 1 : 0;
        }
        errors.rms += error * error;
        errors.worst = std::max(errors.worst, error);
        errors.beyond += error > adaptive_tolerance(s.truth.distance / field.voxel) ? 1 : 0;
        const bool counts = std::abs(s.truth.distance) > 0.25 * field.voxel;
        errors.wrong_sign += counts && (probe.distance < 0) != (s.truth.distance < 0) ? 1 : 0;
        errors.normal_rms += std::pow(glm::length(probe.normal - s.truth.normal), 2);
    }
    errors.rms = std::sqrt(errors.rms / static_cast<double>(samples.size()));
    errors.normal_rms = std::sqrt(errors.normal_rms / static_cast<double>(samples.size()));
    return errors;
}

} // namespace anvil::bench
