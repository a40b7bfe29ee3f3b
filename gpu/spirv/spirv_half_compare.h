// Comparisons of halves in a form that Mesa's software drivers run in less time.
#pragma once

#include <cstdint>
#include <vector>

namespace parity::gpu {

// The module with comparisons of scalar halves, their FMin and FMax, and comparisons of numbers of 32 bits with a
// constant that a half can hold, made in 32 bits, on twice the numbers. LLVM 15 compares halves one by one, some 100
// instructions for eight, and it takes a comparison of widened halves for one of halves; doubled ones it does not. To
// double is exact, so a comparison has the same result, of NaN, infinities and denormals, too. FMin and FMax give the
// operand that is not NaN, as Mesa 22.3 does. Modules without halves are left as they are. The words must be valid
// SPIR-V. Deterministic. Throws Error (failed) for words that are no SPIR-V, as SpirvModule does.
std::vector<std::uint32_t> compareHalvesWidened(std::vector<std::uint32_t> words);

} // namespace parity::gpu
