#include "gpu/spirv/spirv_live.h"

#include <string>

#include <glslang/SPIRV/GLSL.std.450.h>
#include <glslang/SPIRV/spirv.hpp>

namespace parity::gpu {

namespace {

// A literal string: four bytes a word, the first in the lowest bits.
std::string textOf(std::span<const std::uint32_t> words) {
  std::string text;
  for (const std::uint32_t word : words)
    for (int byte = 0; byte < 4; ++byte) {
      const char c = static_cast<char>(word >> (8 * byte) & 0xff);
      if (c == 0) return text;
      text += c;
    }
  return text;
}

} // namespace

// Whether all that an instruction does is its result. Unknown ones do more.
bool SpirvLive::hasOnlyResult(const SpirvInstruction& each) const {
  const auto isWithin = [&](spv::Op first, spv::Op last) {
    return each.opcode >= static_cast<std::uint32_t>(first) && each.opcode <= static_cast<std::uint32_t>(last);
  };
  switch (each.opcode) {
  case spv::OpExtInst: // what writes through a pointer does more
    return each.operands[0] == m_glsl && each.operands[1] != GLSLstd450Modf && each.operands[1] != GLSLstd450Frexp;
  case spv::OpLoad:
    return each.operands.size() < 2 || (each.operands[1] & spv::MemoryAccessVolatileMask) == 0;
  case spv::OpUndef:
  case spv::OpVariable:
  case spv::OpAccessChain:
  case spv::OpInBoundsAccessChain:
  case spv::OpArrayLength:
  case spv::OpPhi:
  case spv::OpCopyLogical:
    return true;
  default:
    return isWithin(spv::OpVectorExtractDynamic, spv::OpTranspose) || isWithin(spv::OpSampledImage, spv::OpImageRead) ||
           isWithin(spv::OpImage, spv::OpImageQuerySamples) || isWithin(spv::OpConvertFToU, spv::OpBitcast) ||
           isWithin(spv::OpSNegate, spv::OpSMulExtended) || isWithin(spv::OpAny, spv::OpFUnordGreaterThanEqual) ||
           isWithin(spv::OpShiftRightLogical, spv::OpBitCount) || isWithin(spv::OpDPdx, spv::OpFwidthCoarse);
  }
}

SpirvLive::SpirvLive(const SpirvModule& module, const SpirvValues& values)
    : m_module(module), m_values(values), m_needed(module.bound()), m_labelOf(module.instructions().size()),
      m_stores(module.bound()) {
  for (const SpirvInstruction& each : module.instructions())
    if (each.opcode == spv::OpExtInstImport && textOf(each.operands) == "GLSL.std.450") m_glsl = each.result;
  for (std::size_t b = 0; b < module.blocks().size(); ++b)
    if (values.runs(b))
      for (std::size_t i = module.blocks()[b].begin; i < module.blocks()[b].end; ++i)
        m_labelOf[i] = module.blocks()[b].label;
  findStores();
  for (std::size_t i = 0; i < m_labelOf.size(); ++i) {
    const SpirvInstruction& each = module.instructions()[i];
    const bool isStore = each.opcode == spv::OpStore && localVariableOf(each.operands[0]) != 0;
    if (m_labelOf[i] != 0 && !isStore && !hasOnlyResult(each)) needOperands(each, m_labelOf[i]);
  }
  while (!m_open.empty()) {
    const std::uint32_t id = m_open.back();
    m_open.pop_back();
    for (const std::uint32_t store : m_stores[id]) needOperands(module.instructions()[store], m_labelOf[store]);
    if (values.valueOf(id)) continue; // it becomes a constant
    const std::size_t at = static_cast<std::size_t>(module.find(id) - module.instructions().data());
    if (m_labelOf[at] != 0) needOperands(*module.find(id), m_labelOf[at]);
  }
}

// Lists the stores into each variable of a function: they are needed where the variable is read.
void SpirvLive::findStores() {
  for (std::size_t i = 0; i < m_labelOf.size(); ++i) {
    const SpirvInstruction& each = m_module.instructions()[i];
    if (m_labelOf[i] == 0 || each.opcode != spv::OpStore) continue;
    if (const std::uint32_t variable = localVariableOf(each.operands[0]))
      m_stores[variable].push_back(static_cast<std::uint32_t>(i));
  }
}

std::uint32_t SpirvLive::localVariableOf(std::uint32_t pointer) const {
  const SpirvInstruction* from = m_module.find(pointer);
  while (from && (from->opcode == spv::OpAccessChain || from->opcode == spv::OpInBoundsAccessChain ||
                  from->opcode == spv::OpCopyObject))
    from = m_module.isBefore(from->operands[0], *from) ? m_module.find(from->operands[0]) : nullptr;
  const bool isLocal = from && from->opcode == spv::OpVariable && from->operands[0] == spv::StorageClassFunction;
  return isLocal ? from->result : 0;
}

void SpirvLive::need(std::uint32_t id) {
  if (id >= m_needed.size() || m_needed[id] || !m_module.find(id)) return;
  m_needed[id] = true;
  m_open.push_back(id);
}

// A literal counts as an id: that keeps a value too many at worst.
void SpirvLive::needOperands(const SpirvInstruction& instruction, std::uint32_t label) {
  if (instruction.opcode == spv::OpPhi) {
    for (std::size_t i = 0; i + 1 < instruction.operands.size(); i += 2)
      if (m_values.canGo(instruction.operands[i + 1], label)) need(instruction.operands[i]);
    return;
  }
  const bool isTwoWay = instruction.opcode == spv::OpBranchConditional;
  if (isTwoWay && m_values.targetsOf(m_module.blockOf(label)).size() == 1) return; // its condition no longer matters
  if (instruction.opcode == spv::OpSelect) {
    if (const auto condition = m_values.valueOf(instruction.operands[0]))
      return need(instruction.operands[*condition != 0 ? 1 : 2]);
  }
  for (const std::uint32_t operand : instruction.operands) need(operand);
}

bool SpirvLive::isNeeded(std::size_t index) const {
  const SpirvInstruction& each = m_module.instructions()[index];
  if (each.opcode == spv::OpStore) {
    const std::uint32_t variable = localVariableOf(each.operands[0]);
    return variable == 0 || m_needed[variable];
  }
  return each.result == 0 || m_needed[each.result] || !hasOnlyResult(each);
}

} // namespace parity::gpu
