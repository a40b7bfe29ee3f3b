// A row of a pixel file's plane as values of 16 bits.
#pragma once

#include <cstdint>
#include <span>

#include "report/pixel_chunk.h"

namespace parity::report {

// The values as PlaneKind says; packed: as many. Every processor gives the same bits.
void packRow(std::span<const float> values, PlaneKind kind, std::span<std::uint16_t> packed);

} // namespace parity::report
