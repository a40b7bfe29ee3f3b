// The mobile presets over their domain, in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "sweep.glsl"
