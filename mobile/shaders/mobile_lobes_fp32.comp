// The mobile path in single precision, of scenes with lobes beside the base's own.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_LOBES
#include "mobile/shaders/mobile.glsl"
