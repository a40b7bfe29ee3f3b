#include "gpu/spirv/spirv_half.h"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glslang/SPIRV/GLSL.std.450.h>
#include <glslang/SPIRV/spirv.hpp>

#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_rewriter.h"

namespace parity::gpu {

namespace {

bool readsImage(std::uint32_t opcode) { return opcode >= spv::OpImageSampleImplicitLod && opcode <= spv::OpImageRead; }

class HalfConverter {
public:
  explicit HalfConverter(const SpirvModule& module) : m_module(module), m_rewriter(module), m_isMoved(module.bound()) {
    findParameters();
    while (markMoved()) {
    }
  }

  std::vector<std::uint32_t> write() {
    if (std::ranges::none_of(m_module.instructions(), [&](const SpirvInstruction& each) { return narrows(each); }))
      return m_module.words();
    makeGlobals();
    return m_rewriter.write([&](const SpirvInstruction& each) {
      if (!narrows(each)) return false;
      narrow(each);
      return true;
    });
  }

private:
  void findParameters() {
    std::uint32_t function = 0;
    for (const SpirvInstruction& each : m_module.instructions()) {
      if (each.opcode == spv::OpFunction) function = each.result;
      if (each.opcode == spv::OpFunctionParameter) m_parameters[function].push_back(each.result);
    }
  }

  bool isMoved(std::uint32_t id) const { return id < m_isMoved.size() && m_isMoved[id]; }
  bool mark(std::uint32_t id, bool moved) {
    if (!moved || id >= m_isMoved.size() || m_isMoved[id]) return false;
    return m_isMoved[id] = true;
  }

  // Marks what image instructions return, and all that may hold it unchanged: parts, variables, parameters and results
  // of functions (by the function's id). Whether it has marked any.
  bool markMoved() {
    bool isNew = false;
    std::uint32_t function = 0;
    for (const SpirvInstruction& each : m_module.instructions()) {
      const auto any = [&](std::size_t first) {
        return std::ranges::any_of(each.operands.subspan(std::min(first, each.operands.size())),
                                   [&](std::uint32_t id) { return isMoved(id); });
      };
      switch (each.opcode) {
      case spv::OpFunction:
        function = each.result;
        break;
      case spv::OpReturnValue:
        isNew |= mark(function, any(0));
        break;
      case spv::OpStore: // into a variable, or a part of one
        for (std::uint32_t place = each.operands[0];;) {
          isNew |= mark(place, any(1));
          const SpirvInstruction* chain = m_module.find(place);
          if (!chain || !isAccessChain(*chain) || !m_module.isBefore(chain->operands[0], *chain)) break;
          place = chain->operands[0];
        }
        break;
      case spv::OpFunctionCall: {
        const std::vector<std::uint32_t>& parameters = m_parameters[each.operands[0]];
        for (std::size_t i = 0; i < parameters.size() && i + 1 < each.operands.size(); ++i) {
          isNew |= mark(parameters[i], isMoved(each.operands[i + 1]));
          isNew |= mark(each.operands[i + 1], isMoved(parameters[i])); // of a pointer
        }
        isNew |= mark(each.result, isMoved(each.operands[0]));
        break;
      }
      case spv::OpCompositeExtract:
      case spv::OpCopyObject:
      case spv::OpLoad:
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
        isNew |= mark(each.result, !each.operands.empty() && isMoved(each.operands[0]));
        break;
      case spv::OpVectorShuffle:
      case spv::OpCompositeInsert:
      case spv::OpCompositeConstruct:
      case spv::OpPhi:
      case spv::OpSelect:
        isNew |= mark(each.result, any(0)); // literals among the operands mark too much at worst
        break;
      default:
        isNew |= mark(each.result, readsImage(each.opcode));
      }
    }
    return isNew;
  }

  bool narrows(const SpirvInstruction& each) const {
    if (each.opcode != spv::OpFConvert || each.operands.empty() || isMoved(each.operands[0])) return false;
    const SpirvShape to = m_module.shapeOfType(each.type);
    return to.bits == 16 && to.rows <= 4 && m_module.shapeOf(each.operands[0]).bits == 32;
  }

  void makeGlobals() {
    m_bool = m_rewriter.typeOf(spv::OpTypeBool, {});
    m_real = m_rewriter.typeOf(spv::OpTypeFloat, {32});
    m_half = m_rewriter.typeOf(spv::OpTypeFloat, {16});
    m_word = m_rewriter.typeOf(spv::OpTypeInt, {32, 0});
    m_halves = m_rewriter.typeOf(spv::OpTypeVector, {m_half, 2});
    const auto word = [&](std::uint32_t value) { return m_rewriter.constantOf(m_word, value); };
    m_one = word(1);
    m_thirteen = word(13);
    m_sixteen = word(16);
    m_signMask = word(0x8000);
    m_magnitudeMask = word(0x7fffffff);
    m_infinity = word(0x7f800000);
    m_most = word((127 + 16) << 23);        // 65536
    m_leastNormal = word((127 - 14) << 23); // 2^-14
    m_rebias = word(0xfffu - (112u << 23)); // the exponent's bias, and just below half of a unit
    m_unit = m_rewriter.realConstant(0.5f); // units of 2^-24 end at its last bit
    m_unitBits = word(std::bit_cast<std::uint32_t>(0.5f));
    m_nan = word(0x7e00);
  }

  // The 16 bits of the half, in a word.
  std::uint32_t bitsOfHalf(std::uint32_t x) {
    const auto word = [&](spv::Op opcode, std::initializer_list<std::uint32_t> operands) {
      return m_rewriter.compute(opcode, m_word, operands);
    };
    const std::uint32_t bits = word(spv::OpBitcast, {x});
    const std::uint32_t sign = word(spv::OpBitwiseAnd, {word(spv::OpShiftRightLogical, {bits, m_sixteen}), m_signMask});
    const std::uint32_t whole = word(spv::OpBitwiseAnd, {bits, m_magnitudeMask});
    const std::uint32_t magnitude = word(spv::OpExtInst, {m_rewriter.library(), GLSLstd450UMin, whole, m_most});

    const std::uint32_t odd = word(spv::OpBitwiseAnd, {word(spv::OpShiftRightLogical, {magnitude, m_thirteen}), m_one});
    const std::uint32_t biased = word(spv::OpIAdd, {magnitude, m_rebias});
    const std::uint32_t normal = word(spv::OpShiftRightLogical, {word(spv::OpIAdd, {biased, odd}), m_thirteen});

    const std::uint32_t real = m_rewriter.compute(spv::OpBitcast, m_real, {magnitude});
    const std::uint32_t sum = m_rewriter.compute(spv::OpFAdd, m_real, {real, m_unit}); // rounds
    m_rewriter.keepExact(sum);
    const std::uint32_t denormal = word(spv::OpISub, {word(spv::OpBitcast, {sum}), m_unitBits});

    const std::uint32_t isDenormal = m_rewriter.compute(spv::OpULessThan, m_bool, {magnitude, m_leastNormal});
    const std::uint32_t number = word(spv::OpSelect, {isDenormal, denormal, normal});
    const std::uint32_t isNan = m_rewriter.compute(spv::OpUGreaterThan, m_bool, {whole, m_infinity});
    return word(spv::OpBitwiseOr, {word(spv::OpSelect, {isNan, m_nan, number}), sign});
  }

  void narrow(const SpirvInstruction& each) {
    const auto count = static_cast<std::uint32_t>(m_module.shapeOfType(each.type).rows);
    std::vector<std::uint32_t> parts = {each.type, each.result};
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t x =
          count == 1 ? each.operands[0] : m_rewriter.compute(spv::OpCompositeExtract, m_real, {each.operands[0], i});
      const std::uint32_t halves = m_rewriter.compute(spv::OpBitcast, m_halves, {bitsOfHalf(x)});
      if (count == 1) return m_rewriter.emit(spv::OpCompositeExtract, {each.type, each.result, halves, 0});
      parts.push_back(m_rewriter.compute(spv::OpCompositeExtract, m_half, {halves, 0}));
    }
    m_rewriter.emit(spv::OpCompositeConstruct, parts);
  }

  const SpirvModule& m_module;
  SpirvRewriter m_rewriter;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> m_parameters; // of functions
  std::vector<bool> m_isMoved;                                                // ids that may hold what an image holds
  std::uint32_t m_bool = 0, m_real = 0, m_half = 0, m_word = 0, m_halves = 0; // types
  std::uint32_t m_one = 0, m_thirteen = 0, m_sixteen = 0, m_signMask = 0, m_magnitudeMask = 0, m_infinity = 0;
  std::uint32_t m_most = 0, m_leastNormal = 0, m_rebias = 0, m_unit = 0, m_unitBits = 0, m_nan = 0;
};

} // namespace

std::vector<std::uint32_t> convertHalvesByBits(std::vector<std::uint32_t> words) {
  const SpirvModule module(std::move(words));
  return HalfConverter(module).write();
}

} // namespace parity::gpu
