// The row filters of PNG (ISO/IEC 15948, section 9).
#pragma once

#include <cstddef>
#include <cstdint>

namespace parity::base {

enum class PngFilter : std::uint8_t { none, sub, up, average, paeth };
inline constexpr std::uint8_t kPngFilters = 5;

// Undoes a filter, in place. above: the row before, not filtered; of the first row zeros. pixelBytes: 1, 2, 3, 4, 6, 8.
void unfilterRow(PngFilter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t size, int pixelBytes);

// Applies Paeth's filter, of the five the one that leaves least of rendered pictures. above: as before.
void filterByPaeth(const std::uint8_t* row, const std::uint8_t* above, std::size_t size, int pixelBytes,
                   std::uint8_t* out);

} // namespace parity::base
