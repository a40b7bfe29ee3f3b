// A mesh's triangles in rectangles of texels: by its TEXCOORD_1, or unwrapped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/packing.h"
#include "bake/light/horizon.h"
#include "scenes/scene.h"

namespace parity::bake {

struct LayoutOptions {
  double texelsPerUnit = 16; // of the mesh's own units
  int padding = 2;           // free texels between charts, half of it (rounded down) before the first
  int maxSide = 2048;        // texels, of a page
};

// A rectangle of texels and the triangles in it.
struct Piece {
  glm::ivec2 size{0}; // texels with the padding, so that pieces may touch
  std::vector<std::uint32_t> triangles;
  Profile profile; // what of it is taken
  Rectangle rectangle() const { return {size, profile.low.empty() ? nullptr : &profile}; }
};

struct MeshLayout {
  std::vector<Piece> pieces;      // none: the mesh has no area
  std::vector<glm::vec2> corners; // 3 a triangle, texels in its piece, y down; 0 for a triangle without area
  int charts = 0;
  std::string note; // "TEXCOORD_1", "unwrapped into 3 charts (no TEXCOORD_1)"
};

// TEXCOORD_1 where checkLightmapUvs takes it, else planar charts (makeCharts). Throws base::Error (exit 4) that
// names the mesh: positions that are not finite, indices beyond the vertices; a piece longer than maxSide.
MeshLayout layOutMesh(const scenes::Mesh& mesh, const LayoutOptions& options);

// Packs all pieces into one. Throws like layOutMesh where it is longer than maxSide.
void joinPieces(const scenes::Mesh& mesh, int maxSide, MeshLayout& layout);

// Moves the triangles of a piece.
void movePiece(MeshLayout& layout, std::size_t piece, const glm::ivec2& by);

} // namespace parity::bake
