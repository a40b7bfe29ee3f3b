// A shader with its specialization constants put in: what they leave of it is a fraction, and a driver reads that in a
// fraction of the time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace parity::gpu {

// The module with the values of the specialization constants 0, 1, 2, ... as plain constants (others keep their
// defaults), without the blocks that can no longer run and the values that nothing reads. No arithmetic on
// floating-point numbers is touched: results keep their bits. Deterministic; some 10 ms for a million bytes. Throws
// Error (failed) for words that are no SPIR-V.
std::vector<std::uint32_t> specializeSpirv(std::span<const std::uint32_t> words,
                                           std::span<const std::uint32_t> constants);

} // namespace parity::gpu
