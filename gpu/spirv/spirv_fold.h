// Instructions on 32-bit integers and booleans, computed on the host as SPIR-V 1.5 defines them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace parity::gpu {

// The result of an instruction, where its known operands decide it; integers as their bits, booleans as 0 or 1. Nothing
// for instructions of other kinds, and where SPIR-V leaves the result undefined (division by 0, shifts of 32 and more).
// opcode: spv::Op. operands: in the instruction's order; nothing: not known.
std::optional<std::uint32_t> foldSpirv(std::uint32_t opcode, std::span<const std::optional<std::uint32_t>> operands);

} // namespace parity::gpu
