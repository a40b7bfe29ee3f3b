// The atlas of a scene's lightmap: unique uvs of all its objects, packed into pages.
#pragma once

#include <string>
#include <vector>

#include "scenes/lightmap_uvs.h"
#include "scenes/scene.h"

namespace parity::bake {

struct AtlasOptions {
  double texelsPerMetre = 16; // of the most stretched direction of each object, at least
  int maxPageSide = 2048;     // a power of two
  int padding = 2;            // free texels between charts, on each side at least half of it
};

struct Atlas {
  int pageSide = 0; // texels, a multiple of 4; pages are square and all of one size
  int pageCount = 0;
  scenes::LightmapUvs uvs;
  // How each mesh got its uvs, one line each: "Suzanne: TEXCOORD_1", "floor: unwrapped into 3 charts (no TEXCOORD_1)".
  std::vector<std::string> notes;
};

// Objects whose material is unlit have no lightmap. Throws base::Error (exit 4) naming the mesh and the reason for what
// cannot be unwrapped, and where the pages would hold more than kMaxTexels.
inline constexpr std::size_t kMaxTexels = std::size_t{1} << 26;
Atlas makeAtlas(const scenes::Scene& scene, const AtlasOptions& options);

} // namespace parity::bake
