// The numerics of a device with arithmetic in half.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#include "numerics.glsl"
