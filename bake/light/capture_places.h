// Where environment captures are taken from, and the box that their reflections are corrected by.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/surface/visibility.h"
#include "scenes/scene.h"

namespace parity::bake {

// World space, metres.
struct CapturePlace {
  glm::vec3 position{0.f};
  // The walls around it: for box parallax (Lagarde and Zanuttini 2012, "Local image-based lighting with
  // parallax-corrected cubemaps"). Holds the position.
  glm::vec3 boxLower{0.f}, boxUpper{0.f};
  float radius = 0; // reaches the farthest corner of the scene's bounds
};

// A capture at this position. Each side of the box is the median of what a bundle of parallel rays meets, no farther
// than the scene's bounds; a side with nothing on it is there.
CapturePlace placeCapture(const scenes::Scene& scene, const lighting::Visibility& visibility,
                          const glm::vec3& position);

// Up to `count` (>= 1) of them, among the points of a grid in the bounds that lie within no closed surface. The first
// has the widest clearance, weighted towards the middle; each further one is the farthest from those before among the
// points with at least half that clearance. Fewer where there are no such points; the middle of the bounds where there
// is none at all. Deterministic. visibility: of the same scene.
std::vector<CapturePlace> findCapturePlaces(const scenes::Scene& scene, const lighting::Visibility& visibility,
                                            int count);

} // namespace parity::bake
