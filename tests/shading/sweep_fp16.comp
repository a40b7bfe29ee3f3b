// The mobile presets over their domain, in half precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#include "sweep.glsl"
