// The functions of anisotropy and films in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lobes_rows.glsl"
