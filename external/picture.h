// A picture that an engine has made of a view, as linear light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/image/image.h"
#include "external/encoding.h"

namespace parity::external {

struct Picture {
  base::Image light;                 // linear Rec.709 as exposed, 3 channels; NaN and infinity as they are in the file
  base::Image alpha;                 // one channel; empty: the picture has none
  std::vector<std::uint8_t> clipped; // for each pixel, 1: a channel tells no more than "at least this much light"
};

// The size is that of the view. Throws Error (exit 3, not comparable) with the file and the reason: another size, grey,
// other primaries, a part of a picture, several pictures, turned by EXIF; values that the encoding does not have (a
// file of floats that is not "linear", a file that says it is linear). Throws Error (exit 4) for what cannot be read.
Picture readPicture(const std::filesystem::path& file, int width, int height, const Encoding& encoding);

// The values of a picture in colour, from 0 to 1 where it holds integers. Throws Error (exit 3) for one that is no
// whole upright picture in colour, or has values that are not finite, and (exit 4) for what cannot be read.
base::Image readValues(const std::filesystem::path& file);

// The values of a picture as light.
base::Image toLight(const base::Image& rgb, const Encoding& encoding);

} // namespace parity::external
