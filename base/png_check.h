// Whether a PNG file is whole, before a decoder sees it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::base {

// Follows the chunks of a PNG file (ISO/IEC 15948, section 5) to its end. Throws Error (exit 4), naming the chunk,
// where one is cut off or does not match its checksum; libpng would complain on stderr in its own words. Returns at
// once where the bytes are no PNG file.
void checkPng(std::span<const std::byte> bytes, const std::string& name);

} // namespace parity::base
