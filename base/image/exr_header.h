// What a plain OpenEXR header says, by OpenEXR's core library. Private to exr_read.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <openexr.h>

#include "base/image/image_io.h"

namespace parity::base {

struct ExrHeader {
  ImageInfo info;
  int width = 0, height = 0;
  bool isTiled = false;
  struct Channel {
    int place = 0; // among the channels of the result
    bool isHalf = false;
  };
  std::vector<Channel> channels; // in the order of the file, which is that of their names
};

// Nothing for all that readExr() does not read.
std::optional<ExrHeader> readExrHeader(exr_const_context_t file, const ImageLimits& limits);

} // namespace parity::base
