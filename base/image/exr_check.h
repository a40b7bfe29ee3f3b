// What an OpenEXR header asks for, before the library takes memory for it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::base {

// Walks the headers of all parts: attributes that are larger than the file, data windows beyond the limits of images,
// tiles that are larger than the limits or more than the file can hold, deep data. Does nothing where the bytes do not
// begin as an OpenEXR file does, and leaves to the library what it does check. head: the first bytes of the file, or
// all; fileBytes: of the whole file. Throws Error (exit 4).
void checkExr(std::span<const std::byte> head, std::size_t fileBytes, const std::string& name);

} // namespace parity::base
