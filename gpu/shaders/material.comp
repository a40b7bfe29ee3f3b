// Materials of scenes without lobes beside the base's own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/shaders/material.glsl"
