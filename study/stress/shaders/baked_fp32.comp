// The functions of baked light in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_BAKED
#include "device_functions.glsl"
