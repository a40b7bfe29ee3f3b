// How the scanlines of a Radiance HDR file run, by its header.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::base {

// As EXIF 2.3 numbers it (tag 274), from the resolution string (G. Ward, "Radiance file formats"): two axes, the first
// that of the scanlines, each with the sign of its direction, +Y up and +X to the right. "-Y 512 +X 1024" is 1: the top
// line first, from the left. Throws Error (exit 4) where there is no such string.
int readHdrOrientation(std::span<const std::byte> bytes, const std::string& name);

} // namespace parity::base
