// How far shadow maps are from the truth: the high-end path's visibility of a light against rays, pixel by pixel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/device/device.h"
#include "gpu/shadows/shadow_options.h"
#include "scenes/scene.h"

namespace parity::shadows {

struct Setup {
  const scenes::Scene& scene;
  const scenes::Camera& camera;
  std::uint32_t width = 512, height = 512;
  gpu::ShadowOptions options = {};
  std::vector<scenes::Light> others = {}; // whose maps share the image with the light's
};

// What is wrong in pixels of which a light's facing part is seen.
struct VisibilityError {
  std::size_t outside = 0, inside = 0;       // pixels outside and inside the band of 2 texels about the shadows' edges
  double outsideMean = 0, insideMean = 0;    // mean absolute error of visibility
  std::size_t acne = 0, leaks = 0;           // of those outside by more than 0.1 too dark, too light
  std::vector<float> map, exact, difference; // a plane of the picture each, row by row; 0 where nothing is seen
  std::vector<std::uint8_t> band;            // 1: within it
};

// A pixel is in the band where rays from the plane of its triangle, within 2
// texels of its place in the map, do not all see what it sees itself; or where that plane ends before, seen from the
// light. Exact visibility is lighting::Visibility's, from the geometric normal's side, as in the reference.
VisibilityError measureVisibility(const gpu::Device& device, const Setup& setup, const scenes::Light& light);

} // namespace parity::shadows
