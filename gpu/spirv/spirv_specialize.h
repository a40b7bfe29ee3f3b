// A shader with its specialization constants put in: what they leave of it is a fraction, and a driver reads that in a
// fraction of the time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace parity::gpu {

// The module with the values of the specialization constants 0, 1, 2, ... as plain constants (others keep their
// defaults), without the blocks and functions that can no longer run and the values that nothing reads. Arithmetic on
// floating-point numbers is not touched; a driver may still order it in another way than it would have. The words must
// be valid SPIR-V. Deterministic; some 5 ms for a million bytes. Throws Error (failed) for words that are no SPIR-V (as
// SpirvModule does), and for a value of a constant that is not of 32 bits.
std::vector<std::uint32_t> specializeSpirv(std::span<const std::uint32_t> words,
                                           std::span<const std::uint32_t> constants);

} // namespace parity::gpu
