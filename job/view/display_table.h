// A display transform as a table, for a page that cannot run OpenColorIO.
#pragma once

#include <cstddef>
#include <vector>

#include "base/image/color.h"
#include "base/image/image.h"

namespace parity::job {

// A cube of kDisplayTableSide^3 nodes; the coordinate of a linear channel v is (log2(v) - kDisplayTableMinLog2) /
// (kDisplayTableMaxLog2 - kDisplayTableMinLog2) of the way from the first node to the last, within 0..1.
// Read trilinearly, "ACES SDR" is within 2/255 where no channel is below a quarter of another (33 nodes: 2.8), in the
// file 227 kB; a channel that the transform clamps to black beside a bright one may be off by more.
inline constexpr int kDisplayTableSide = 65, kDisplayTableMinLog2 = -12, kDisplayTableMaxLog2 = 10;

// Display-encoded RGB of each node: kDisplayTableSide^2 wide (red fastest, then green), as many rows (blue) as nodes.
base::Image makeDisplayTable(const base::DisplayTransform& display);

// Whether the page needs the table: it knows "sRGB" and "raw" by formula.
bool needsDisplayTable(const base::DisplayTransform& display);

// pixels/display.js (report/pixel_chunk.h) with the plane "table" and the members minLog2 and maxLog2.
std::vector<std::byte> encodeDisplayTable(const base::DisplayTransform& display);
inline constexpr const char* kDisplayTableFile = "pixels/display.js";

} // namespace parity::job
