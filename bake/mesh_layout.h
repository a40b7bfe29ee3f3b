// Where a mesh's triangles lie in a block of texels of its own: by its TEXCOORD_1, or unwrapped.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::bake {

struct LayoutOptions {
  double texelsPerUnit = 16; // of the mesh's own units
  int padding = 2;           // free texels between charts, half of it (rounded down) before the first
  int maxSide = 2048;        // texels, of the block with its padding
};

struct MeshLayout {
  glm::ivec2 size{0};             // texels with the padding, so that blocks may touch; 0: the mesh has no area
  std::vector<glm::vec2> corners; // 3 a triangle, texels in the block, y down; 0 for a triangle without area
  int charts = 0;
  bool fromFile = false; // TEXCOORD_1
  std::string note;      // "TEXCOORD_1", "unwrapped into 3 charts (no TEXCOORD_1)"
};

// TEXCOORD_1 where checkLightmapUvs takes it, else planar charts (makeCharts), packed. Throws base::Error (exit 4) that
// names the mesh: positions that are not finite, indices beyond the vertices; more than maxSide needed.
MeshLayout layOutMesh(const scenes::Mesh& mesh, const LayoutOptions& options);

} // namespace parity::bake
