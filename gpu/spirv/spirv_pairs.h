// Buffers of vectors, accessed two components at a time: Mesa's software drivers take less time for that.
#pragma once

#include <cstdint>
#include <vector>

namespace parity::gpu {

// The module with these buffers declared as arrays of two 64-bit integers, whose bits are those of a vector:
//   - storage buffers that consist of vectors of four 32-bit components, in structs and arrays of any depth
//   - uniform buffers of the same kind, where an index that is no constant reaches into them
// Each load and store of a vector becomes one of two integers. Mesa 22.3 accesses such buffers component by component,
// in a loop over the lanes: with half of the components a vector takes two thirds of the instructions. All values keep
// their bits. A buffer stays as it is where something else uses it than loads and stores of vectors, loads of their
// components by constant indices, and loads of structs and arrays of known length; and where its members are coherent
// or volatile. The device must have shaderInt64.
// The words must be valid SPIR-V with logical addressing. Deterministic. Throws Error (failed) for words that are no
// SPIR-V, as SpirvModule does.
std::vector<std::uint32_t> accessBuffersByPairs(std::vector<std::uint32_t> words);

} // namespace parity::gpu
