// The numerics of a device without arithmetic in half.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "numerics.glsl"
