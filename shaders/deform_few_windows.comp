#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The deformation kernel for CPU devices, for a few occluders of a few shapes.
#define FIELD_WINDOWS
#define FEW_OCCLUDERS
#include "deform.glsl"
