// The atlas of a scene's lightmap: unique uvs of all its objects, packed into pages.
#pragma once

#include <string>
#include <vector>

#include "scenes/gltf/lightmap_uvs.h"
#include "scenes/scene.h"

namespace parity::bake {

struct AtlasOptions {
  double texelsPerMetre = 16; // of the most stretched direction of each object, at least by mean over each chart
  int maxPageSide = 2048;     // a multiple of 4, up to base::kMaxImageSide
  int padding = 2;            // free texels between charts, half of it (rounded down) along a page's borders
};

struct Atlas {
  int pageSide = 0; // texels, a multiple of 4; pages are square and all of one size
  int pageCount = 0;
  scenes::LightmapUvs uvs;
  // How each mesh got its uvs, one line each: "Suzanne: TEXCOORD_1", "floor: unwrapped into 3 charts (no TEXCOORD_1)".
  // A mesh whose instances differ in scale has a line for each of its layouts.
  std::vector<std::string> notes;
};

// Rectangles of charts begin and end at texel borders: a bilinear read within a chart reaches at most one texel beyond
// its border, so that dilation by one and a padding of two keep charts apart. No texel is of two instances.
// Instances of a mesh share a layout where their scales are within a factor of 2 of each other.
// No lightmap have objects whose material is unlit, and those without area; a triangle without area has its corners in
// the padding. Throws base::Error (exit 4) naming the mesh and the reason for what cannot be unwrapped, where the pages
// would hold more than kMaxTexels, and where nothing is left to bake; (usage) for options out of range.
inline constexpr std::size_t kMaxTexels = std::size_t{1} << 26;
Atlas makeAtlas(const scenes::Scene& scene, const AtlasOptions& options);

// Where a point of an instance's triangle lies on its page, in texels (texel (x, y) is [x, x+1) x [y, y+1)). u and v:
// the barycentric weights of corners 1 and 2. The instance has a lightmap.
inline glm::vec2 texelPosition(const Atlas& atlas, std::uint32_t instance, std::uint32_t triangle, float u, float v) {
  const scenes::LightmapUvs::Place& place = atlas.uvs.places[instance];
  const glm::vec2* corner = atlas.uvs.corners.data() + place.firstCorner + 3 * std::size_t{triangle};
  return ((1 - u - v) * corner[0] + u * corner[1] + v * corner[2] + place.offset) * static_cast<float>(atlas.pageSide);
}

} // namespace parity::bake
