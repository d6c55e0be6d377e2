#include "engine/deform/cpu_kernel.h"

namespace anvil {

CpuKernel::CpuKernel(const DeformInput& input, const DeformMotion& motion)
    : table_(segment_table(input)), poses_(kernel_poses(input, motion)) {
    check_sizes(input, motion);
    kernel_.segments = table_.segments.data();
    kernel_.nodes = input.occluders.nodes.data();
    kernel_.occluders = input.occluders.occluders.data();
    kernel_.volumes = input.occluders.volumes.data();
    kernel_.field_words = input.occluders.words();
    kernel_.params = kernel_params(input, motion);
    kernel_.points = input.points.data();
    kernel_.fields = input.fields.data();
    kernel_.shapes = table_.shapes.data();
    kernel_.targets = motion.targets.data();
    kernel_.poses = poses_.data();
    kernel_.start_distances = input.start_distances.data();
}

} // namespace anvil
