// Neighbouring texels of a cube face that are filtered together.
#pragma once

namespace parity::lighting {

inline constexpr int kMaxTileSide = 16, kMaxTileTexels = kMaxTileSide * kMaxTileSide;

// A square of texels of a mip that is faceSize texels wide, row by row.
struct TexelTile {
  int face = 0, left = 0, top = 0;
  int side = 1; // 1, 2 or a multiple of 4, at most kMaxTileSide
  int faceSize = 1;
  int count() const { return side * side; }
};

} // namespace parity::lighting
