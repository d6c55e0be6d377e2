#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/deform/backend.h"
#include "engine/deform/fan_normals.h"
#include "engine/deform/float_loop.h"
#include "engine/deform/narrow.h"

namespace anvil {

namespace {

template <class Wide>
auto narrow_vector(const std::vector<Wide>& values) {
    return narrowed(std::span<const Wide>(values));
}

/// narrowed() of numbers, on all cores.
std::vector<float> narrow_numbers(const std::vector<double>& values) {
    std::vector<float> result(values.size());
    parallel_for(values.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            result[i] = narrowed(values[i]);
        }
    });
    return result;
}

class FloatSession final : public DeformSession {
  public:
    FloatSession(std::shared_ptr<const DeformInput> input, FloatLoop loop)
        : loop_(loop), input_(std::move(input)), points_(narrow_vector(input_->points)),
          fields_(narrow_numbers(input_->fields)), results_(points_.size()) {
        refresh_occluders();
    }

    void refresh_shapes() override {
        const SegmentTable table = segment_table(*input_);
        segments_ = narrow_vector(table.segments);
        shapes_ = narrow_vector(table.shapes);
    }

    void refresh_occluders() override {
        start_distances_ = narrow_numbers(input_->start_distances);
        start_distances_.resize(points_.size(), narrowed(infinity));
        occluders_ = narrow_vector(input_->occluders.occluders);
        nodes_ = narrow_vector(input_->occluders.nodes);
        refresh_shapes(); // influence curves are among the segments
    }

    void update(const DeformMotion& motion) override {
        if (!fits_handles(motion, input_->handle_count)) {
            throw InternalError("the deformation's input and motion do not fit each other");
        }
        const auto targets = narrow_vector(motion.targets);
        const auto poses = narrow_vector(kernel_poses(*input_, motion));
        FloatArrays arrays;
        arrays.params = narrowed(kernel_params(*input_, motion));
        arrays.params.point_count = static_cast<uint32_t>(points_.size());
        arrays.params.field_stride = arrays.params.point_count;
        arrays.points = points_;
        arrays.fields = fields_;
        arrays.start_distances = start_distances_;
        arrays.segments = segments_;
        arrays.shapes = shapes_;
        arrays.occluders = occluders_;
        arrays.nodes = nodes_;
        arrays.targets = targets;
        arrays.poses = poses;
        arrays.volumes = input_->occluders.volumes;
        arrays.field_words = input_->occluders.words();
        arrays.results = results_;
        parallel_for(points_.size(), 256, [&](size_t begin, size_t end) { loop_(arrays, begin, end); });
        ready_ = true;
    }

    void wait() override {}

    std::vector<PointResult> download() override {
        if (!ready_) {
            throw InternalError("a session's result was asked for before its first update");
        }
        std::vector<PointResult> results;
        results.reserve(results_.size());
        for (const kernel::f32::VertexResult& r : results_) {
            results.push_back({Vec3(r.displacement), r.steps, r.samples, r.flags});
        }
        return results;
    }

    std::vector<Vec3> download_normals() override {
        std::vector<Vec3> ends;
        std::vector<Vec3> normals;
        find_fan_normals(*input_, download(), ends, normals);
        return normals;
    }

  private:
    FloatLoop loop_;
    std::shared_ptr<const DeformInput> input_;
    std::vector<glm::vec3> points_;
    std::vector<float> fields_;
    std::vector<float> start_distances_;
    std::vector<kernel::f32::ShapeSegment> segments_;
    std::vector<kernel::f32::CurveRange> shapes_;
    std::vector<kernel::f32::Occluder> occluders_;
    std::vector<kernel::f32::ShapeNode> nodes_;
    std::vector<kernel::f32::VertexResult> results_;
    bool ready_ = false;
};

class FloatBackend final : public Backend {
  public:
    explicit FloatBackend(bool avx2) : avx2_(avx2) {}

    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        return std::make_unique<FloatSession>(std::move(input), avx2_ ? avx2_float_loop : plain_float_loop);
    }
    std::string device_name() const override { return "cpu, float"; }
    std::string driver_name() const override {
        return avx2_ ? "shared formulas for AVX2" : "shared formulas";
    }

  private:
    bool avx2_;
};

} // namespace

#ifdef ANVIL_AVX2
bool has_avx2_float_loop() {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}
#else
void avx2_float_loop(const FloatArrays& arrays, size_t begin, size_t end) {
    plain_float_loop(arrays, begin, end);
}

bool has_avx2_float_loop() {
    return false;
}
#endif

std::unique_ptr<Backend> make_float_cpu_backend(bool widest) {
    return std::make_unique<FloatBackend>(widest && has_avx2_float_loop());
}

} // namespace anvil
