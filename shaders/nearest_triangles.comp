#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What of a mesh may be nearest to a point, one point an invocation: what fields are baked with.

layout(local_size_x = 64) in; // search_workgroup in engine/gpu/triangle_search.cpp

#define real float
#define real3 vec3

#include "shared/invocation.glsl"
#include "shared/search_tree.h"

layout(push_constant, scalar) uniform Parameters { uint count; };

layout(binding = 0, scalar) readonly buffer Nodes { TreeNode nodes[]; };
layout(binding = 1, scalar) readonly buffer Triangles { TreeTriangle triangles[]; };
layout(binding = 2, scalar) readonly buffer Points { vec3 points[]; };
layout(binding = 3, scalar) writeonly buffer Found { uint found[]; }; // MOST_NEAR for each point

uint point;      // the one at work
uint near_count; // triangles that were found

uint tree_size() {
    return nodes.length();
}

TreeNode tree_node(uint i) {
    return nodes[i];
}

TreeTriangle tree_triangle(uint i) {
    return triangles[i];
}

void found_near(uint triangle) {
    if (near_count < MOST_NEAR) {
        found[point * MOST_NEAR + near_count] = triangle;
    }
    ++near_count;
}

float least(float x, float y) {
    return min(x, y);
}

float clamped(float x, float high) {
    return min(max(x, 0.0), high);
}

float share(float x) {
    return clamped(x, 1.0);
}

#include "shared/flat_triangle.h"
#include "shared/nearest_triangles.h"

void main() {
    point = invocation_index();
    if (point >= count) {
        return;
    }
    near_count = 0u;
    find_nearest(points[point]);
    // What there is no room for, and a place for the rest.
    uint used = near_count > MOST_NEAR ? 0u : near_count;
    for (uint k = used; k < MOST_NEAR; ++k) {
        found[point * MOST_NEAR + k] = NO_TRIANGLE;
    }
}
