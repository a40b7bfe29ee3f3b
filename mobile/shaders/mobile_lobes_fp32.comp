// The mobile path in single precision, of scenes with coat or sheen.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_LOBES
#include "mobile/shaders/mobile.glsl"
