#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The deformation kernel for CPU devices, for any occluders or none.
#define FIELD_WINDOWS
#include "deform.glsl"
