#include "gpu/spirv/spirv_fold.h"

#include <algorithm>
#include <limits>

#include <glslang/SPIRV/spirv.hpp>

namespace parity::gpu {

namespace {

using Known = std::optional<std::uint32_t>;

std::int32_t asSigned(std::uint32_t bits) { return static_cast<std::int32_t>(bits); }

Known foldOne(std::uint32_t opcode, std::uint32_t a) {
  switch (opcode) {
  case spv::OpCopyObject:
  case spv::OpBitcast:
    return a;
  case spv::OpSNegate:
    return 0u - a;
  case spv::OpNot:
    return ~a;
  case spv::OpLogicalNot:
    return a == 0 ? 1 : 0;
  default:
    return std::nullopt;
  }
}

Known foldDivision(std::uint32_t opcode, std::uint32_t a, std::uint32_t b) {
  const std::int32_t x = asSigned(a), y = asSigned(b);
  if (b == 0) return std::nullopt;
  const bool isUnsigned = opcode == spv::OpUDiv || opcode == spv::OpUMod;
  if (!isUnsigned && x == std::numeric_limits<std::int32_t>::min() && y == -1) return std::nullopt;
  switch (opcode) {
  case spv::OpUDiv:
    return a / b;
  case spv::OpUMod:
    return a % b;
  case spv::OpSDiv:
    return static_cast<std::uint32_t>(x / y);
  case spv::OpSRem: // the sign of x
    return static_cast<std::uint32_t>(x % y);
  default: { // OpSMod: the sign of y
    const std::int32_t rest = x % y;
    return static_cast<std::uint32_t>(rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest);
  }
  }
}

// NOLINTNEXTLINE(readability-function-size): a table of opcodes
Known foldTwo(std::uint32_t opcode, std::uint32_t a, std::uint32_t b) {
  switch (opcode) {
  case spv::OpIAdd:
    return a + b;
  case spv::OpISub:
    return a - b;
  case spv::OpIMul:
    return a * b;
  case spv::OpUDiv:
  case spv::OpUMod:
  case spv::OpSDiv:
  case spv::OpSRem:
  case spv::OpSMod:
    return foldDivision(opcode, a, b);
  case spv::OpShiftRightLogical:
    return b < 32 ? Known(a >> b) : std::nullopt;
  case spv::OpShiftRightArithmetic:
    return b < 32 ? Known(static_cast<std::uint32_t>(asSigned(a) >> b)) : std::nullopt;
  case spv::OpShiftLeftLogical:
    return b < 32 ? Known(a << b) : std::nullopt;
  case spv::OpBitwiseOr:
  case spv::OpLogicalOr:
    return a | b;
  case spv::OpBitwiseAnd:
  case spv::OpLogicalAnd:
    return a & b;
  case spv::OpBitwiseXor:
    return a ^ b;
  case spv::OpIEqual:
  case spv::OpLogicalEqual:
    return a == b;
  case spv::OpINotEqual:
  case spv::OpLogicalNotEqual:
    return a != b;
  case spv::OpUGreaterThan:
    return a > b;
  case spv::OpUGreaterThanEqual:
    return a >= b;
  case spv::OpULessThan:
    return a < b;
  case spv::OpULessThanEqual:
    return a <= b;
  case spv::OpSGreaterThan:
    return asSigned(a) > asSigned(b);
  case spv::OpSGreaterThanEqual:
    return asSigned(a) >= asSigned(b);
  case spv::OpSLessThan:
    return asSigned(a) < asSigned(b);
  case spv::OpSLessThanEqual:
    return asSigned(a) <= asSigned(b);
  default:
    return std::nullopt;
  }
}

} // namespace

std::optional<std::uint32_t> foldSpirv(std::uint32_t opcode, std::span<const std::optional<std::uint32_t>> operands) {
  const auto isKnown = [](const Known& each) { return each.has_value(); };
  if (opcode == spv::OpSelect && operands.size() == 3)
    return operands[0] ? (*operands[0] != 0 ? operands[1] : operands[2]) : std::nullopt;
  if (operands.size() == 2) { // one operand may decide
    const bool isAnd = opcode == spv::OpLogicalAnd || opcode == spv::OpBitwiseAnd;
    if (isAnd && (operands[0] == 0u || operands[1] == 0u)) return 0;
    if (opcode == spv::OpLogicalOr && (operands[0] == 1u || operands[1] == 1u)) return 1;
  }
  if (!std::ranges::all_of(operands, isKnown)) return std::nullopt;
  if (operands.size() == 1) return foldOne(opcode, *operands[0]);
  if (operands.size() == 2) return foldTwo(opcode, *operands[0], *operands[1]);
  return std::nullopt;
}

} // namespace parity::gpu
