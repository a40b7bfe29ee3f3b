// The rows of a plain PNG file by libdeflate, three times as fast as by zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace parity::base {

// Unpacks the image data of a PNG file that is not interlaced, and undoes the row filters. rows: all of them, each
// behind the byte of its filter. pixelBytes: of one pixel, at least 8 bits a sample. False where libpng has to do it,
// or to say what is wrong; the rows are then of no use.
bool inflatePngRows(std::span<const std::byte> file, std::span<std::uint8_t> rows, std::size_t rowBytes,
                    int pixelBytes);

} // namespace parity::base
