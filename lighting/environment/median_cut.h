// An environment as a set of points: for lobes that are wide and have no prefiltered cube.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/panorama_cells.h"

namespace parity::lighting {

// Stands for a part of the environment.
struct EnvironmentPoint {
  glm::vec3 direction{0.f, 1.f, 0.f}; // unit, world: where the part's light comes from on average
  glm::vec3 light{0.f};               // its radiance times its solid angle, linear Rec.709
};

// Cuts the environment into at most `count` parts of about equal weight, each again and again across its longer side
// (Debevec 2005, "A Median Cut Algorithm for Light Probe Sampling"). Unlike there a part's weight is its light and, to
// three tenths, its solid angle, so that no part of a dim sky is too wide for a lobe; and a part's direction is that of
// its light, not the middle of the part. A lobe's sum over the points is exact where the lobe is linear over each part.
// The light of all points is that of the environment. Deterministic.
std::vector<EnvironmentPoint> cutEnvironment(const PanoramaCells& cells, int count);

} // namespace parity::lighting
