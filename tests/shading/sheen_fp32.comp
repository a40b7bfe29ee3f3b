// The sheen's functions in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "sheen_rows.glsl"
