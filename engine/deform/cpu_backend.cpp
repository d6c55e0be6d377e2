#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/deform/backend.h"
#include "engine/deform/cpu_kernel.h"
#include "engine/deform/fan_normals.h"

namespace anvil {

namespace {

class CpuSession final : public DeformSession {
  public:
    explicit CpuSession(std::shared_ptr<const DeformInput> input) : input_(std::move(input)) {
        ends_.reserve(input_->points.size() + input_->fans.rim.size());
    }

    void update(const DeformMotion& motion) override {
        const CpuKernel prototype(*input_, motion);
        results_.resize(input_->points.size());
        ready_ = true;
        parallel_for(results_.size(), 256, [&](size_t begin, size_t end) {
            kernel::f64::DeformKernel kernel = prototype.kernel();
            for (size_t i = begin; i < end; ++i) {
                const kernel::f64::VertexResult r = kernel.deformed(static_cast<uint32_t>(i));
                results_[i] = {r.displacement, r.steps, r.samples, r.flags};
            }
        });
        find_fan_normals(*input_, results_, ends_, normals_);
    }

    void wait() override {}

    std::vector<PointResult> download() override {
        check_ready();
        return results_;
    }

    std::vector<Vec3> download_normals() override {
        check_ready();
        return normals_;
    }

    void refresh_shapes() override {}
    void refresh_occluders() override {}

  private:
    void check_ready() const {
        if (!ready_) {
            throw InternalError("a session's result was asked for before its first update");
        }
    }

    std::shared_ptr<const DeformInput> input_;
    std::vector<PointResult> results_;
    std::vector<Vec3> ends_; ///< of the points, then the rim
    std::vector<Vec3> normals_;
    bool ready_ = false;
};

class CpuBackend final : public Backend {
  public:
    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        return std::make_unique<CpuSession>(std::move(input));
    }
    std::string device_name() const override { return "cpu"; }
    std::string driver_name() const override { return "double-precision reference"; }
};

} // namespace

std::unique_ptr<Backend> make_cpu_backend() {
    return std::make_unique<CpuBackend>();
}

} // namespace anvil
