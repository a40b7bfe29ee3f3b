// KTX 2 files of Basis Universal, as KHR_texture_basisu has them. Other formats of KTX 2 are refused.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image/image.h"
#include "base/image/image_limits.h"

namespace parity::base {

struct Ktx2Header {
  int width = 0, height = 0; // of the first level
  // That decoding takes beside the file and the result: the transcoder's own memory.
  std::size_t transcoderBytes = 0;
};

// Checks header, descriptor and index (KTX File Format 2.0, sections 3 and 5): a two-dimensional picture of ETC1S (by
// BasisLZ) or UASTC (plain or by Zstandard), whose parts lie within the file. Throws Error (exit 4), naming what is
// wrong.
Ktx2Header readKtx2Header(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

// The first level, RGBA; alpha is 255 where the file has none. The transcoder runs as a sandboxed module, loaded on
// first use. Throws Error (exit 4): damaged, beyond the limits; (failed): the module is not there.
Image8 decodeKtx2(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

} // namespace parity::base
