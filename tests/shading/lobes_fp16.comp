// The functions of anisotropy and films in half precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#include "lobes_rows.glsl"
