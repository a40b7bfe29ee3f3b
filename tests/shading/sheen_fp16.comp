// The sheen's functions in half precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#include "sheen_rows.glsl"
