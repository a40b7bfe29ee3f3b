// GGX towards four directions at once, in float: for estimates that decide where samples go and what a control variate
// is, not what is summed.
#pragma once

#include <numbers>

#include <glm/glm.hpp>

#include "lighting/environment/float4.h"

namespace parity::reference {

using lighting::Float4;

struct FourDirections {
  Float4 x{}, y{}, z{}; // unit
};

// Of light from four directions L, all of one frame with normal N and view V: half vector h = V + L.
struct FourCosines {
  Float4 NoL, VoH, tan2; // of the angle between N and h

  FourCosines(const glm::vec3& N, const glm::vec3& V, const FourDirections& L)
      : NoL(N.x * L.x + N.y * L.y + N.z * L.z) {
    const Float4 x = V.x + L.x, y = V.y + L.y, z = V.z + L.z, across = N.x * x + N.y * y + N.z * z;
    VoH = 0.5f * lighting::squareRoot(x * x + y * y + z * z);
    // From the part of h beside N, so that narrow lobes keep their digits.
    const Float4 sideX = x - N.x * across, sideY = y - N.y * across, sideZ = z - N.z * across;
    constexpr float kLeast = 1e-20f, kMost = 1e6f;
    tan2 = lighting::smaller((sideX * sideX + sideY * sideY + sideZ * sideZ) /
                                 lighting::larger(across * across, Float4{} + kLeast),
                             Float4{} + kMost);
  }
};

// D_GGX (shading/brdf.glsl) by the tangent: alpha2 (1 + tan2)^2 / (pi (alpha2 + tan2)^2). alpha2 > 0.
inline Float4 D_GGX(const Float4& alpha2, const Float4& tan2) {
  const Float4 k = (1 + tan2) / (alpha2 + tan2);
  return alpha2 * k * k * static_cast<float>(std::numbers::inv_pi);
}

// V_SmithGGXCorrelated (shading/brdf.glsl). NoV, NoL > 0.
inline Float4 V_SmithGGXCorrelated(const Float4& alpha2, float NoV, const Float4& NoL) {
  const Float4 ofView = NoL * lighting::squareRoot((NoV - alpha2 * NoV) * NoV + alpha2);
  const Float4 ofLight = NoV * lighting::squareRoot((NoL - alpha2 * NoL) * NoL + alpha2);
  return 0.5f / (ofView + ofLight);
}

inline Float4 schlickWeight(const Float4& VoH) {
  const Float4 x = lighting::larger(1 - VoH, Float4{}), x2 = x * x;
  return x2 * x2 * x;
}

} // namespace parity::reference
