// Conversions to half in a form that Mesa's software drivers compile in less time.
#pragma once

#include <cstdint>
#include <vector>

namespace parity::gpu {

// The module with each OpFConvert from 32 to 16 bits, of scalars and vectors, replaced by some 20 instructions: Mesa
// 22.3 makes 50 of each. To nearest, ties to even; denormals, infinities and the sign of zero are kept, every NaN
// becomes 0x7e00 with its sign: Fabian Giesen, "float->half variants" (2012), its float_to_half_fast3_rtne. Deviation:
// what is above 65536 is cut to that first, which becomes infinite as it is rounded. Conversions of what an image may
// have returned stay: Mesa truncates in those, and the pictures are to be the same. Lines of the source text (OpLine)
// are left out. The words must be valid SPIR-V. Deterministic. Throws Error (failed) for words that are no SPIR-V, as
// SpirvModule does.
std::vector<std::uint32_t> convertHalvesByBits(std::vector<std::uint32_t> words);

} // namespace parity::gpu
