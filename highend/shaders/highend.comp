// The high-end path of scenes without coat and sheen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "highend/shaders/highend.glsl"
