// The values behind a view's pictures as files that a page can load without a server: one JavaScript statement each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/image/image.h"

namespace parity::report {

// How a plane's values are stored, 16 bits each.
enum class PlaneKind {
  rgb16f,  // 3 channels of IEEE half: linear light. Finite values beyond 65504 become 65504, NaN and infinities stay
  unorm16, // 1 channel, 0..1 (clamped; NaN as 1) as 0..65535, rounded
  uint16,  // 1 channel of whole numbers, 0..65535
};

struct PixelPlane {
  std::string name; // ASCII without quotes and backslashes
  PlaneKind kind;
  const base::Image* values; // 3 or 1 channels
};

struct EncodedPlane {
  std::string name;
  PlaneKind kind;
  std::string data; // base64 of a raw DEFLATE stream (RFC 1951)
};

// The stream holds a bit for each pixel, row by row, from the lowest bit of each byte on: whether the pixel differs
// from the one before (the pixel before the first is 0; unused bits of the last byte are 0). Then, channel after
// channel, it holds the differences of these pixels to the pixel before, modulo 65536: first the low bytes of all, then
// the high bytes. The same values give the same bytes.
EncodedPlane encodePlane(const PixelPlane& plane);

// The file's text: parityChunk({"file":FILE,"format":2,"width":W,"height":H,"planes":[{"name","kind","data"},...]});
// members: further numbers of the object. file: relative to the report's folder, ASCII without quotes and backslashes.
std::vector<std::byte> makeChunk(std::string_view file, int width, int height, std::span<const EncodedPlane> planes,
                                 std::span<const std::pair<std::string_view, int>> members = {});

// Puts another file name in the place of the one that makeChunk was given.
void renameChunk(std::vector<std::byte>& chunk, std::string_view file);

// The object in it, as JSON: without the call.
std::string_view chunkObject(std::span<const std::byte> chunk);

} // namespace parity::report
