#include "gpu/spirv/spirv_count.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glslang/SPIRV/GLSL.std.450.h>
#include <glslang/SPIRV/spirv.hpp>

#include "base/error.h"

namespace parity::gpu {

namespace {

// Operations of an instruction of GLSL.std.450 whose largest operand has n components; 0: it converts.
std::optional<std::uint64_t> extendedOperations(std::uint32_t instruction, std::uint64_t n) {
  switch (instruction) {
  case GLSLstd450PackSnorm4x8:
  case GLSLstd450PackUnorm4x8:
  case GLSLstd450PackSnorm2x16:
  case GLSLstd450PackUnorm2x16:
  case GLSLstd450PackHalf2x16:
  case GLSLstd450UnpackSnorm2x16:
  case GLSLstd450UnpackUnorm2x16:
  case GLSLstd450UnpackHalf2x16:
  case GLSLstd450UnpackSnorm4x8:
  case GLSLstd450UnpackUnorm4x8:
    return 0;
  case GLSLstd450Fma:
  case GLSLstd450Exp:
  case GLSLstd450Log:
  case GLSLstd450FClamp:
  case GLSLstd450UClamp:
  case GLSLstd450SClamp:
  case GLSLstd450NClamp:
  case GLSLstd450Length:
    return 2 * n;
  case GLSLstd450FMix:
  case GLSLstd450Pow:
  case GLSLstd450Distance:
  case GLSLstd450Normalize:
  case GLSLstd450FaceForward:
    return 3 * n;
  case GLSLstd450Reflect:
    return 4 * n;
  case GLSLstd450Refract:
    return 5 * n + 7;
  case GLSLstd450SmoothStep:
    return 9 * n;
  case GLSLstd450Cross:
    return 9;
  default:
    break;
  }
  const bool isPlain = (instruction >= GLSLstd450Round && instruction <= GLSLstd450Atan2) ||
                       (instruction >= GLSLstd450Exp2 && instruction <= GLSLstd450InverseSqrt) ||
                       (instruction >= GLSLstd450FMin && instruction <= GLSLstd450SMax) ||
                       instruction == GLSLstd450Step || instruction == GLSLstd450Ldexp ||
                       instruction == GLSLstd450NMin || instruction == GLSLstd450NMax ||
                       (instruction >= GLSLstd450FindILsb && instruction <= GLSLstd450FindUMsb);
  if (!isPlain) return std::nullopt;
  return n;
}

class Counter {
public:
  explicit Counter(const SpirvModule& module) : m_module(module), m_weights(module.blocks().size(), 1) {
    for (const SpirvInstruction& each : module.instructions())
      if (each.opcode == spv::OpDecorate && each.operands[1] == spv::DecorationDescriptorSet)
        m_places[each.operands[0]].first = each.operands[2];
      else if (each.opcode == spv::OpDecorate && each.operands[1] == spv::DecorationBinding)
        m_places[each.operands[0]].second = each.operands[2];
    for (const SpirvBlock& block : module.blocks()) {
      if (block.merge == 0) continue;
      const std::optional<std::uint64_t> trips = module.tripsOf(block);
      if (!trips) ++m_cost.openLoops;
      for (const std::size_t b : module.blocksOfLoop(block)) m_weights[b] *= trips.value_or(1);
    }
  }

  ShaderCost count() {
    for (std::size_t b = 0; b < m_module.blocks().size(); ++b) {
      m_weight = m_weights[b];
      const SpirvBlock& block = m_module.blocks()[b];
      for (std::size_t i = block.begin; i < block.end; ++i) add(m_module.instructions()[i]);
    }
    for (const auto& [place, fetches] : m_fetches) m_cost.images.push_back({place.first, place.second, fetches});
    return m_cost;
  }

private:
  void addOperations(const SpirvShape& shape, std::uint64_t count) {
    if (shape.kind == SpirvShape::Kind::real && shape.bits > 32) refuseCost("64-bit reals are not counted");
    std::uint64_t& sum = shape.kind != SpirvShape::Kind::real ? m_cost.integer
                         : shape.bits == 16                   ? m_cost.fp16
                                                              : m_cost.fp32;
    sum += count * m_weight;
  }

  // One operation a component, of the type of the result or of the first operand.
  void addByResult(const SpirvInstruction& each) {
    const SpirvShape shape = m_module.shapeOfType(each.type);
    addOperations(shape, shape.components());
  }
  void addByOperand(const SpirvInstruction& each) {
    const SpirvShape shape = m_module.shapeOf(each.operands[0]);
    addOperations(shape, shape.components());
  }

  void addExtended(const SpirvInstruction& each) { // set, instruction, operands
    const SpirvShape result = m_module.shapeOfType(each.type);
    std::uint64_t n = result.components();
    for (const std::uint32_t operand : each.operands.subspan(2))
      n = std::max(n, m_module.shapeOf(operand).components());
    const std::optional<std::uint64_t> operations = extendedOperations(each.operands[1], n);
    if (!operations) refuseCost(fmt::format("instruction {} of GLSL.std.450 is not counted", each.operands[1]));
    if (*operations == 0)
      m_cost.conversions += n * m_weight;
    else
      addOperations(result, *operations);
  }

  void addFetch(std::uint32_t image) {
    const SpirvInstruction* from = m_module.find(image);
    while (from && from->opcode != spv::OpVariable) from = m_module.find(from->operands[0]);
    if (!from) refuseCost("a texture read of no variable");
    m_fetches[m_places[from->result]] += m_weight;
  }

  void add(const SpirvInstruction& each);

  const SpirvModule& m_module;
  std::vector<std::uint64_t> m_weights;                                      // of blocks: how often each runs at most
  std::uint64_t m_weight = 1;                                                // of the block at hand
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> m_places; // of variables: set, binding
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> m_fetches;
  ShaderCost m_cost;
};

// NOLINTNEXTLINE(readability-function-size): a table of opcodes
void Counter::add(const SpirvInstruction& each) {
  const auto shapeAt = [&](std::size_t operand) { return m_module.shapeOf(each.operands[operand]); };
  const std::uint32_t op = each.opcode;
  const auto isWithin = [op](spv::Op first, spv::Op last) {
    return op >= static_cast<std::uint32_t>(first) && op <= static_cast<std::uint32_t>(last);
  };
  if (isWithin(spv::OpImageSampleImplicitLod, spv::OpImageDrefGather)) return addFetch(each.operands[0]);
  if (isWithin(spv::OpConvertFToU, spv::OpQuantizeToF16)) {
    m_cost.conversions += m_module.shapeOfType(each.type).components() * m_weight;
    return;
  }
  // any, all, isnan, ...; comparisons of integers and of reals
  if (isWithin(spv::OpAny, spv::OpUnordered) || isWithin(spv::OpIEqual, spv::OpFUnordGreaterThanEqual))
    return addByOperand(each);
  switch (op) {
  case spv::OpVectorTimesMatrix: { // r by r x c
    const SpirvShape matrix = shapeAt(1);
    return addOperations(matrix, matrix.cols * (2 * matrix.rows - 1));
  }
  case spv::OpMatrixTimesVector: {
    const SpirvShape matrix = shapeAt(0);
    return addOperations(matrix, matrix.rows * (2 * matrix.cols - 1));
  }
  case spv::OpMatrixTimesMatrix: {
    const SpirvShape left = shapeAt(0), right = shapeAt(1);
    return addOperations(left, left.rows * right.cols * (2 * left.cols - 1));
  }
  case spv::OpDot:
    return addOperations(shapeAt(0), 2 * shapeAt(0).rows - 1);
  case spv::OpExtInst:
    return addExtended(each);
  case spv::OpSNegate:
  case spv::OpFNegate:
  case spv::OpIAdd:
  case spv::OpFAdd:
  case spv::OpISub:
  case spv::OpFSub:
  case spv::OpIMul:
  case spv::OpFMul:
  case spv::OpUDiv:
  case spv::OpSDiv:
  case spv::OpFDiv:
  case spv::OpUMod:
  case spv::OpSRem:
  case spv::OpSMod:
  case spv::OpFRem:
  case spv::OpFMod:
  case spv::OpVectorTimesScalar:
  case spv::OpMatrixTimesScalar:
  case spv::OpOuterProduct:
  case spv::OpSelect:
  case spv::OpLogicalEqual:
  case spv::OpLogicalNotEqual:
  case spv::OpLogicalOr:
  case spv::OpLogicalAnd:
  case spv::OpLogicalNot:
  case spv::OpShiftRightLogical:
  case spv::OpShiftRightArithmetic:
  case spv::OpShiftLeftLogical:
  case spv::OpBitwiseOr:
  case spv::OpBitwiseXor:
  case spv::OpBitwiseAnd:
  case spv::OpNot:
  case spv::OpBitFieldInsert:
  case spv::OpBitFieldSExtract:
  case spv::OpBitFieldUExtract:
  case spv::OpBitReverse:
  case spv::OpBitCount:
    return addByResult(each);
  case spv::OpLoad: {
    // A sampler is no memory: it is counted where it is read.
    const SpirvInstruction* type = m_module.find(each.type);
    if (type && (type->opcode == spv::OpTypeSampledImage || type->opcode == spv::OpTypeImage ||
                 type->opcode == spv::OpTypeSampler))
      return;
    m_cost.memory += m_weight;
    return;
  }
  case spv::OpStore:
  case spv::OpCopyMemory:
  case spv::OpArrayLength:
  case spv::OpImageRead:
  case spv::OpImageWrite:
  case spv::OpImageQuerySizeLod:
  case spv::OpImageQuerySize:
  case spv::OpImageQueryLod:
  case spv::OpImageQueryLevels:
  case spv::OpImageQuerySamples:
    m_cost.memory += m_weight;
    return;
  case spv::OpVectorExtractDynamic:
  case spv::OpVectorInsertDynamic:
  case spv::OpVectorShuffle:
  case spv::OpCompositeConstruct:
  case spv::OpCompositeExtract:
  case spv::OpCompositeInsert:
  case spv::OpCopyObject:
  case spv::OpCopyLogical:
  case spv::OpTranspose:
  case spv::OpBitcast:
    m_cost.moves += m_weight;
    return;
  case spv::OpBranchConditional:
  case spv::OpSwitch:
    m_cost.branches += m_weight;
    return;
  case spv::OpVariable: // nothing that runs
  case spv::OpAccessChain:
  case spv::OpInBoundsAccessChain:
  case spv::OpPhi:
  case spv::OpUndef:
  case spv::OpImage:
  case spv::OpSampledImage:
  case spv::OpLoopMerge:
  case spv::OpSelectionMerge:
  case spv::OpBranch:
  case spv::OpReturn:
  case spv::OpUnreachable:
  case spv::OpNop:
  case spv::OpLine:
  case spv::OpNoLine:
  case spv::OpControlBarrier:
  case spv::OpMemoryBarrier:
    return;
  default:
    refuseCost(fmt::format("instruction {} is not counted", op));
  }
}

} // namespace

void refuseCost(const std::string& reason) { throw base::Error(base::ExitCode::failed, "SPIR-V", "cost", reason); }

ShaderCost countOperations(const SpirvModule& module) { return Counter(module).count(); }

} // namespace parity::gpu
