// Whether the data of a JPEG is whole: decoders fill what is missing, and say nothing.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::base {

// What libjpeg warns of as it decodes the whole image (its entropy coded data; at an eighth of the size): bytes that
// are missing, too many or wrong. Empty where it warns of nothing, and of what is no JPEG or cannot be decoded at all.
std::string findJpegDamage(std::span<const std::byte> bytes);

} // namespace parity::base
