#include "gpu/spirv/spirv_half_compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <glslang/SPIRV/GLSL.std.450.h>
#include <glslang/SPIRV/spirv.hpp>

#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_rewriter.h"

namespace parity::gpu {

namespace {

constexpr float kLargestHalf = 65504;

bool isComparison(std::uint32_t opcode) {
  return opcode >= spv::OpFOrdEqual && opcode <= spv::OpFUnordGreaterThanEqual;
}

// A half's last bit is the 14th of a number of 32 bits. Some that are below the least half pass, too.
bool mayBeHalf(float value) {
  return std::abs(value) <= kLargestHalf && (std::bit_cast<std::uint32_t>(value) & 0x1fffu) == 0;
}

class HalfComparer {
public:
  explicit HalfComparer(const SpirvModule& module) : m_module(module), m_rewriter(module) {}

  std::vector<std::uint32_t> write() {
    const auto all = m_module.instructions();
    const bool hasHalves = std::ranges::any_of(all, [](const SpirvInstruction& each) {
      return each.opcode == spv::OpTypeFloat && each.operands.front() == 16;
    });
    if (!hasHalves || std::ranges::none_of(all, [&](const SpirvInstruction& each) {
          return comparesHalves(each) || comparesWithHalf(each) || isMinOrMax(each);
        }))
      return m_module.words();
    m_bool = m_rewriter.typeOf(spv::OpTypeBool, {});
    m_real = m_rewriter.typeOf(spv::OpTypeFloat, {32});
    m_two = m_rewriter.realConstant(2);
    return m_rewriter.write([&](const SpirvInstruction& each) {
      if (isMinOrMax(each))
        select(each);
      else if (comparesHalves(each) || comparesWithHalf(each))
        m_rewriter.emit(each.opcode, {each.type, each.result, twice(each.operands[0]), twice(each.operands[1])});
      else
        return false;
      return true;
    });
  }

private:
  bool isScalar(std::uint32_t id, std::uint32_t bits) const {
    const SpirvShape shape = m_module.shapeOf(id);
    return shape.kind == SpirvShape::Kind::real && shape.bits == bits && shape.components() == 1;
  }
  // Of 32 bits.
  bool isConstantHalf(std::uint32_t id) const {
    const SpirvInstruction* found = m_module.find(id);
    if (found && found->opcode == spv::OpConstantNull) return true;
    return found && found->opcode == spv::OpConstant && mayBeHalf(std::bit_cast<float>(found->operands[0]));
  }

  bool comparesHalves(const SpirvInstruction& each) const {
    return isComparison(each.opcode) && isScalar(each.operands[0], 16);
  }
  bool comparesWithHalf(const SpirvInstruction& each) const {
    return isComparison(each.opcode) && isScalar(each.operands[0], 32) &&
           (isConstantHalf(each.operands[0]) || isConstantHalf(each.operands[1]));
  }
  // Operands of OpExtInst: the library, the function, its arguments. Of the libraries of a shader only GLSL.std.450 has
  // functions that return a half.
  bool isMinOrMax(const SpirvInstruction& each) const {
    return each.opcode == spv::OpExtInst && each.operands.size() == 4 && isScalar(each.result, 16) &&
           (each.operands[1] == GLSLstd450FMin || each.operands[1] == GLSLstd450FMax);
  }

  std::uint32_t twice(std::uint32_t id) {
    const std::uint32_t wide = isScalar(id, 16) ? m_rewriter.compute(spv::OpFConvert, m_real, {id}) : id;
    const std::uint32_t product = m_rewriter.compute(spv::OpFMul, m_real, {wide, m_two});
    m_rewriter.keepExact(product);
    return product;
  }

  // FMin or FMax: the first operand where it is a number and the result, else the second.
  void select(const SpirvInstruction& each) {
    const spv::Op comparison = each.operands[1] == GLSLstd450FMin ? spv::OpFUnordLessThan : spv::OpFUnordGreaterThan;
    const std::uint32_t first = each.operands[2], second = each.operands[3], a = twice(first), b = twice(second);
    const std::uint32_t isNumber = m_rewriter.compute(spv::OpFOrdEqual, m_bool, {a, a}),
                        isBetter = m_rewriter.compute(comparison, m_bool, {a, b}),
                        isFirst = m_rewriter.compute(spv::OpLogicalAnd, m_bool, {isBetter, isNumber});
    m_rewriter.emit(spv::OpSelect, {each.type, each.result, isFirst, first, second});
  }

  const SpirvModule& m_module;
  SpirvRewriter m_rewriter;
  std::uint32_t m_bool = 0, m_real = 0, m_two = 0;
};

} // namespace

std::vector<std::uint32_t> compareHalvesWidened(std::vector<std::uint32_t> words) {
  const SpirvModule module(std::move(words));
  return HalfComparer(module).write();
}

} // namespace parity::gpu
