#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The deformation kernel for a few occluders of a few shapes: most edits.
#define FEW_OCCLUDERS
#include "deform.glsl"
