// Baked light (lighting/baked_light.h), what it was made from, and what is told of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bake/scene_hash.h"
#include "base/image/image.h"
#include "lighting/baked_light.h"

namespace parity::bake {

using Capture = lighting::BakedCapture;
using lighting::LocalLights;

inline constexpr double kNoLossDb = 999; // in place of infinity, which JSON has not

// Told in reports: figures of the bake itself.
struct BakeFigures {
  std::uint64_t texels = 0;                                    // of charts
  double samplesPerTexel = 0, errorMedian = 0, errorWorst = 0; // of the gathered light
  double shareWithinError = 1;                                 // of texels that reached the wanted error
  double quantizedError = 0,
         storedError = 0; // rms of what mobile decodes, in 8 bits and after ASTC (bake/encode/lq_encoding.h)
  double colorDb = kNoLossDb, directionDb = kNoLossDb; // that ASTC leaves their codes
};

// As a bake's folder holds it.
struct BakedLight : lighting::BakedLight {
  std::string scene;    // its name
  std::string settings; // in words
  std::string astc;     // "4x4", "6x6" or "none"
  SceneHashes hashes;
  int pageSide = 0;
  std::vector<base::Image> sources; // of each page: irradiance RGB, SH, normal: 10 channels
  BakeFigures figures;
};

} // namespace parity::bake
