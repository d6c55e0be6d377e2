// Which item an invocation works on. The includer has declared its local_size_x before.
#ifndef ANVIL_INVOCATION_GLSL
#define ANVIL_INVOCATION_GLSL

/// Index of this invocation in a dispatch of one or two dimensions; may lie beyond the count.
/// Consecutive groups of indices go to the two halves of the dispatch in turn: a device that splits a dispatch into
/// two fixed halves (lavapipe) then shares work that is clustered in a part of the mesh.
uint invocation_index() {
    uint groups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint half_groups = (groups + 1u) / 2u;
    uint place = group < half_groups ? 2u * group : 2u * (group - half_groups) + 1u;
    return place * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

#endif
