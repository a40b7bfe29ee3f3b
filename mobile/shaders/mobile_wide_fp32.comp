// The mobile path in fp32, its knobs as data: many sets of them without compiling again.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_LOBES
#define PARITY_WIDE
#include "mobile/shaders/mobile.glsl"
