// Small OpenEXR files made by hand.
#pragma once

#include <cstddef>
#include <vector>

namespace parity::tests {

struct ExrLayout {
  int compression = 0;   // 0 none, 1 rle, 2 zips, 3 zip, 4 piz, 5 pxr24, 6 b44, 7 b44a, 8 dwaa, 9 dwab
  int linesAChunk = 1;   // of that compression
  bool isTiled = false;  // 4 x 4 texels
  bool isPacked = false; // rle only: each chunk is a run of 128s
  int envmap = -1;       // 0: latitude and longitude, 1: a cube; -1: not said
  int displayWidth = 8;  // of the display window; the data window has 8
};

// 8 x 4 texels of three half floats, B, G, R.
std::vector<std::byte> makeExr(const ExrLayout& layout);

} // namespace parity::tests
