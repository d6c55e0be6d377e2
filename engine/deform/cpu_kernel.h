// The shared kernel in double with the arrays that it reads, for whoever runs it point by point.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/deform/deform_kernel.h"

#include <vector>

namespace anvil {

/// Input and motion must outlive it and have start distances where there are occluders.
class CpuKernel {
  public:
    /// @throws InternalError if the sizes of input and motion do not fit each other.
    CpuKernel(const DeformInput& input, const DeformMotion& motion);

    /// To be copied, one a thread.
    const kernel::f64::DeformKernel& kernel() const { return kernel_; }
    const std::vector<kernel::f64::Pose>& poses() const { return poses_; }

    CpuKernel(const CpuKernel&) = delete;
    CpuKernel& operator=(const CpuKernel&) = delete;

  private:
    SegmentTable table_;
    std::vector<kernel::f64::Pose> poses_;
    kernel::f64::DeformKernel kernel_;
};

} // namespace anvil
