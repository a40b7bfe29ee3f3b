// A call of one of the mobile path's functions; C++ and GLSL.
#ifndef PARITY_MOBILE_SHADERS_PROBE_H
#define PARITY_MOBILE_SHADERS_PROBE_H

#ifdef __cplusplus
#include <cstdint>
namespace parity::mobile {
using uint = std::uint32_t;
#define PARITY_CONST inline constexpr unsigned
#else
#define PARITY_CONST const uint
#endif

PARITY_CONST kProbeEnvironmentBrdf = 0u; // of F0, roughness, NoV: A, B, F0 A + B, N.V as the path rounds it
PARITY_CONST kProbeNonmetal = 1u;        // the same by the form for nonmetals, whose F0 is 0.04
PARITY_CONST kProbeDirectLobe = 2u;      // of F0, roughness, NoV, x: N.L, y: azimuth of L to V: pi f N.L in RGB; N.L
PARITY_CONST kProbeLocalLobe = 3u;       // the same of point and spot lights
PARITY_CONST kProbeFalloff = 4u;         // of x: distance in m, y: range in m
PARITY_CONST kProbeCone = 5u;            // of x: cosine, y: of the inner, z: of the outer angle
PARITY_CONST kProbeMip = 6u;             // of roughness
PARITY_CONST kProbeEncode = 7u;          // of the colour x, y, z

struct ProbeCall {
  uint function; // kProbe...
  float F0, roughness, NoV;
  float x, y, z, unused;
};

#undef PARITY_CONST
#ifdef __cplusplus
} // namespace parity::mobile
#endif
#endif
