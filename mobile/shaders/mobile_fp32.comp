// The mobile path in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "mobile/shaders/mobile.glsl"
