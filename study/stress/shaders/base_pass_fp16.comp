// The pieces of the mobile base pass in native fp16.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#define PARITY_BASE_PASS
#include "device_functions.glsl"
