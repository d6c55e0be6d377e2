// Parameters of viewer/mesh.{vert,frag}; the same text for C++ (with vec4, mat4, uint named) and GLSL.
#ifndef ANVIL_MESH_PARAMETERS_H
#define ANVIL_MESH_PARAMETERS_H

#define MESH_HAS_REGION 1u  // slots, ends, region_normals and marks are bound
#define MESH_FLAT 2u        // one normal a triangle
#define MESH_LINES 4u       // drawn as lines, in `colour` alone
#define MESH_TINTED 8u      // the region in the colours of its weights
#define MESH_CONTOURS 16u   // lines of equal distance in the region
#define MESH_PLAIN_BACK 32u // back faces are not told apart
#define MESH_SELECTION 64u  // `selected` is bound
#define MESH_LIGHTS 256u    // times 0 to 3: studio, clay, metal, stripes

/// Push constants: what is drawn. The mesh's space to view space.
struct MeshParameters {
    mat4 model_view;
    vec4 colour; // linear; alpha: opacity
    uint flags;
    uint point_count;      // entries of `ends`
    float contour_spacing; // world
    float contour_end;     // no lines beyond
    float orthographic;    // 1: parallel view, 0: eye at the origin of view space
};

#endif
