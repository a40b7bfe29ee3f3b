// Which pixels of a picture are compared: a mask from a file, an area, or both.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame.h"
#include "base/image/image_limits.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

enum class MaskKind {
  automatic, // floats and 32-bit integers are ids, 8- and 16-bit integers weights
  ids,       // every pixel belongs to the region of its number
  weights,   // one region: white is in, black is out, grey counts for its share of white (as stored, no sRGB)
};
inline constexpr std::array<std::string_view, 3> kMaskKindNames = {"auto", "ids", "weights"};

struct MaskRequest {
  std::filesystem::path file; // empty: no mask
  MaskKind kind = MaskKind::automatic;
  std::vector<std::uint32_t> ignoredIds;
  std::optional<Rect> area;   // only pixels in it count
  base::ImageLimits limits{}; // of the file
};

struct MaskRegions {
  std::vector<base::PixelList> lists;
  std::string where;              // "area 24,8,10,4 of mask ids.exr"; empty: the whole picture
  std::vector<std::string> notes; // which ids have no pixel in the area
};

// The regions of a picture of that size: "id 7" for each id in ascending order (its first channel counts), "mask" for
// weights, "area" or "image" without a mask. None is empty. Throws Error: notComparable where the mask has another size
// or the area reaches beyond the picture; failed (exit 4) where the file cannot be read, no pixel is left, an id is no
// whole number of 0 to 2^32-1 (with its place) or there are more than 65536 of them, weights are not grey, not opaque
// or outside [0,1], or an ignored id does not occur in the mask.
MaskRegions findRegions(const MaskRequest& request, int width, int height);

} // namespace parity::compare
