#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// The deformation kernel for CPU devices, without occluders.
#define FIELD_WINDOWS
#define WIDE_STORES
#include "deform.glsl"
