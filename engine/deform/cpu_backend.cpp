#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/deform/backend.h"
#include "engine/deform/cpu_kernel.h"

namespace anvil {

namespace {

class CpuSession final : public DeformSession {
  public:
    explicit CpuSession(const DeformInput& input) : input_(input) {
        if (input_.start_distances.empty()) {
            input_.start_distances.assign(input_.points.size(), infinity);
        }
    }

    void update(const DeformMotion& motion) override {
        const CpuKernel prototype(input_, motion);
        results_.resize(input_.points.size());
        ready_ = true;
        parallel_for(results_.size(), 256, [&](size_t begin, size_t end) {
            kernel::f64::DeformKernel kernel = prototype.kernel();
            for (size_t i = begin; i < end; ++i) {
                const kernel::f64::VertexResult r = kernel.deformed(static_cast<uint32_t>(i));
                results_[i] = {r.displacement, r.steps, r.samples, r.flags};
            }
        });
    }

    void wait() override {}

    std::vector<PointResult> download() override {
        if (!ready_) {
            throw InternalError("a session's result was asked for before its first update");
        }
        return results_;
    }

  private:
    DeformInput input_;
    std::vector<PointResult> results_;
    bool ready_ = false;
};

class CpuBackend final : public Backend {
  public:
    std::unique_ptr<DeformSession> prepare(const DeformInput& input) override {
        return std::make_unique<CpuSession>(input);
    }
    std::string device_name() const override { return "cpu"; }
    std::string driver_name() const override { return "double-precision reference"; }
};

} // namespace

std::unique_ptr<Backend> make_cpu_backend() {
    return std::make_unique<CpuBackend>();
}

} // namespace anvil
