// How far one path's environment BRDF is from another's on the materials of a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "study/plot/env_brdf.h"

namespace parity::plot {

// Of F0 A + F90 B, channel by channel, test minus reference: over the points of the material's surfaces, and over N.V
// as a sphere shows it (weight 2 N.V).
struct MaterialDeviation {
  std::string name;
  std::size_t points = 0;                        // of its surfaces: 1 where nothing is textured
  double roughness = 0, least = 0, greatest = 0; // mean and range of roughness
  glm::dvec3 F0{0.0};                            // mean
  std::string form;                              // paths::EnvBrdf::form of the test: "general", "nonmetal", ...
  double mean = 0;                               // of the absolute deviation
  double bias = 0;                               // of the deviation: below 0 the test is darker
  double max = 0;                                // of the absolute deviation over N.V >= .05 ...
  double NoVOfMax = 0;                           // ... and where
  double referenceMultiple = 0,
         testMultiple = 0; // means of what scatters more than once, which is in none of the above
};

// In the scene's order, without unlit ones; the rest of those without triangles by their factors alone. Textured ones
// are asked at 256 points of a low-discrepancy sequence over their area in the world.
std::vector<MaterialDeviation> deviationsOf(const scenes::Scene& scene, const PlottedPair& pair);

} // namespace parity::plot
