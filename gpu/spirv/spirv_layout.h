// Where the parts of buffers lie, as far as buffers consist of vectors of four 32-bit components.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/spirv/spirv_module.h"

namespace parity::gpu {

inline constexpr std::uint32_t kSpirvVectorBytes = 16; // of a vector of four 32-bit components

// A part of a buffer that an access chain leads to. Lengths are in such vectors.
struct SpirvPlace {
  std::uint32_t type = 0;                                       // of the part
  std::uint32_t vectors = 0;                                    // before it, by constant indices
  std::vector<std::pair<std::uint32_t, std::uint32_t>> dynamic; // ids of other indices, and vectors in a step of each
  std::optional<std::uint32_t> component;                       // of the vector: then the type is that of a number
};

class SpirvLayout {
public:
  // The module must outlive this.
  explicit SpirvLayout(const SpirvModule& module);

  // A vector of four 32-bit integers or reals.
  bool isVector(std::uint32_t type) const;
  // Whether the type is a vector, or an array or struct of such types, each at a multiple of 16 bytes.
  bool hasVectorsOnly(std::uint32_t type) const;

  // How many vectors a type reaches over that hasVectorsOnly, gaps included. None: it holds an array of no known
  // length.
  std::optional<std::uint32_t> vectorsIn(std::uint32_t type) const;
  struct Part {
    std::uint32_t type = 0, vectors = 0; // vectors: before it
  };
  // The members of a struct, or the elements of an array of known length. Empty for other types.
  std::vector<Part> partsOf(std::uint32_t type) const;
  // Where an access chain leads that begins at a buffer of a type that hasVectorsOnly. None: to a component by an index
  // that is no constant, or by indices that are not of 32 bits.
  std::optional<SpirvPlace> placeOf(const SpirvInstruction& chain, std::uint32_t typeOfBuffer) const;

private:
  const SpirvModule& m_module;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> m_offsets; // bytes, by struct and member
  std::map<std::uint32_t, std::uint32_t> m_strides;                           // bytes, by array
};

} // namespace parity::gpu
