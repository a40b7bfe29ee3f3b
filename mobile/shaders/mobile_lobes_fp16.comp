// The mobile path in half precision, of scenes with coat or sheen.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP16
#define PARITY_LOBES
#include "mobile/shaders/mobile.glsl"
