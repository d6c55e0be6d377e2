#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The deformation kernel for one occluder of one shape: most edits.
#define SINGLE_LEAF
#include "deform.glsl"
