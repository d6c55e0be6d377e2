#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "viewer/mesh_parameters.h"

layout(push_constant, scalar) uniform Block { MeshParameters parameters; };

layout(binding = 0, scalar) readonly buffer Camera { mat4 projection; };
layout(binding = 1, scalar) readonly buffer Positions { vec3 positions[]; };
layout(binding = 2, scalar) readonly buffer Normals { vec3 normals[]; };
// Of a region that a session moves: each vertex's number among `region_normals`, the first of which have `ends`.
layout(binding = 3, scalar) readonly buffer Slots { uint slots[]; };
layout(binding = 4, scalar) readonly buffer Ends { vec3 ends[]; };
layout(binding = 5, scalar) readonly buffer RegionNormals { vec3 region_normals[]; };
layout(binding = 6, scalar) readonly buffer Marks { vec2 marks[]; }; // weight, distance
layout(binding = 7, scalar) readonly buffer Selected { uint selected[]; };

layout(location = 0) out vec3 view_position;
layout(location = 1) out vec3 view_normal;
layout(location = 2) out vec2 mark; // outside a region: no weight, distance `outside`
layout(location = 3) out float chosen; // 1: selected

// So far below zero that a triangle at a region's rim has no lines of equal distance: between a distance and
// none there are no others.
const float outside = -1e30;

bool has(uint flag) { return (parameters.flags & flag) != 0u; }

void main() {
    vec3 position = positions[gl_VertexIndex];
    vec3 normal = normals[gl_VertexIndex];
    mark = vec2(0.0, outside);
    chosen = has(MESH_SELECTION) ? float(selected[gl_VertexIndex]) : 0.0;
    if (has(MESH_HAS_REGION)) {
        uint slot = slots[gl_VertexIndex];
        if (slot != 0xffffffffu) {
            normal = region_normals[slot];
            if (slot < parameters.point_count) {
                position = ends[slot];
                mark = marks[slot].y >= 0.0 ? marks[slot] : vec2(marks[slot].x, outside);
            }
        }
    }
    view_position = (parameters.model_view * vec4(position, 1.0)).xyz;
    view_normal = mat3(parameters.model_view) * normal;
    gl_Position = projection * vec4(view_position, 1.0);
    if (has(MESH_LINES)) {
        gl_Position.z -= 2e-4 * gl_Position.w; // in front of the triangles that they border
    }
}
