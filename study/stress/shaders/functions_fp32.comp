// The shading functions in fp32.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "device_functions.glsl"
