// The shading functions in native fp16.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#include "device_functions.glsl"
