// The border between the program and the module that holds the transcoder of Basis Universal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace parity::base {

// Writes the first level of a KTX 2 file of Basis Universal (ETC1S or UASTC; the latter plain or by Zstandard) as RGBA,
// 8 bits each, row by row from the top: texels.size() is 4 width height, as the file's header says. memory: bytes that
// the transcoder may take. damage: stays empty, or becomes what is wrong with the file. Any thread.
using DecodeBasis = void (*)(std::span<const std::byte> file, std::size_t memory, std::span<std::uint8_t> texels,
                             std::string& damage);
// The module exports it with C linkage.
inline constexpr const char* kDecodeBasis = "parityDecodeBasis";

} // namespace parity::base
