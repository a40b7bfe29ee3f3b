// OpenEXR by its core library in C, without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/image/image_io.h"

namespace parity::base {

// The bytes of an OpenEXR file: one part of scanlines, compressed by ZIP (16 lines a chunk, on all cores), float or
// half channels. writeImage() (image_io.h) says what they are called, and what an image and options have to be. The
// same image gives the same bytes on any number of threads. `name` is for messages. Throws Error (exit 4).
std::vector<std::byte> encodeExr(const Image& image, const WriteOptions& options, const std::string& name);

} // namespace parity::base
