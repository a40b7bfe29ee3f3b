// Mutations of glTF files that keep the container whole, so that they reach what lies behind it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace parity::tests {

// Mutates `size` bytes in place, returns the new size, at most maxSize: as LLVMFuzzerMutate does.
using MutateBytes = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t maxSize);

// A custom mutator of libFuzzer: edits the JSON (values for edge values, other types, words of glTF; keys and elements
// deleted, doubled, moved), the bytes behind one buffer view or data uri (with the checksums of a PNG made right
// again), or any bytes, by `mutateBytes`. The result depends on nothing else than the arguments and what that does.
std::size_t mutateGltf(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed,
                       MutateBytes mutateBytes);

} // namespace parity::tests
