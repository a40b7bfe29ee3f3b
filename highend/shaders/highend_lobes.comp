// The high-end path of scenes with coat or sheen.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_LOBES
#include "highend/shaders/highend.glsl"
