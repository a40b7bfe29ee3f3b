#include "gpu/spirv/spirv_values.h"

#include <algorithm>
#include <array>

#include <glslang/SPIRV/spirv.hpp>

#include "gpu/spirv/spirv_fold.h"

namespace parity::gpu {

namespace {

// Instructions all of whose operands are ids, those that can be folded among them.
bool hasOnlyIds(std::uint32_t opcode) {
  return opcode == spv::OpCopyObject || (opcode >= spv::OpConvertFToU && opcode <= spv::OpBitCount);
}

} // namespace

SpirvValues::SpirvValues(const SpirvModule& module, std::span<const std::uint32_t> constants)
    : m_module(module), m_states(module.bound(), State::unseen), m_values(module.bound()),
      m_runs(module.blocks().size()), m_targets(module.blocks().size()) {
  setConstants(constants);
  for (std::size_t block = 0; block < module.blocks().size(); ++block)
    if (const std::uint32_t function = module.blocks()[block].entryOf) m_entries[function] = block;
  for (const SpirvInstruction& each : module.instructions()) {
    const auto entry = m_entries.find(each.opcode == spv::OpEntryPoint ? each.operands[1] : 0);
    if (entry != m_entries.end()) m_runs[entry->second] = true;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t block = 0; block < module.blocks().size(); ++block)
      if (m_runs[block]) changed |= visit(block);
  }
}

// All that stands before the functions, and their parameters.
void SpirvValues::setConstants(std::span<const std::uint32_t> constants) {
  bool isInFunction = false;
  for (const SpirvInstruction& each : m_module.instructions()) {
    isInFunction = isInFunction || each.opcode == spv::OpFunction;
    if (each.result == 0 || (isInFunction && each.opcode != spv::OpFunctionParameter)) continue;
    switch (each.opcode) {
    case spv::OpSpecConstantTrue:
    case spv::OpConstantTrue:
      set(each.result, State::known, 1);
      break;
    case spv::OpSpecConstantFalse:
    case spv::OpConstantFalse:
      set(each.result, State::known, 0);
      break;
    case spv::OpConstant:
    case spv::OpSpecConstant:
      if (isScalar(each.type))
        set(each.result, State::known, each.operands[0]);
      else
        set(each.result, State::varying);
      break;
    case spv::OpConstantNull:
      set(each.result, isScalar(each.type) ? State::known : State::varying);
      break;
    case spv::OpSpecConstantOp: {
      SpirvInstruction computed = each;
      computed.opcode = each.operands[0];
      computed.operands = each.operands.subspan(1);
      evaluate(computed, 0);
      break;
    }
    default:
      set(each.result, State::varying);
    }
    const std::optional<std::uint32_t> number = m_module.specIdOf(each.result);
    if (!number || *number >= constants.size() || m_states[each.result] != State::known) continue;
    const bool isNumber = each.opcode == spv::OpSpecConstant;
    m_values[each.result] = isNumber ? constants[*number] : std::uint32_t{constants[*number] != 0};
  }
}

bool SpirvValues::set(std::uint32_t id, State state, std::uint32_t value) {
  if (m_states[id] == State::known && state == State::known && m_values[id] != value) state = State::varying;
  if (state <= m_states[id]) return false;
  m_states[id] = state;
  m_values[id] = value;
  return true;
}

bool SpirvValues::isScalar(std::uint32_t type) const {
  const SpirvShape shape = m_module.shapeOfType(type);
  return shape.components() == 1 &&
         (shape.kind == SpirvShape::Kind::boolean || (shape.kind == SpirvShape::Kind::integer && shape.bits == 32));
}

bool SpirvValues::visit(std::size_t index) {
  const SpirvBlock& block = m_module.blocks()[index];
  bool changed = false;
  for (std::size_t i = block.begin; i < block.end; ++i) {
    const SpirvInstruction& each = m_module.instructions()[i];
    if (each.result != 0 && m_states[each.result] != State::varying) changed |= evaluate(each, block.label);
    if (each.opcode != spv::OpFunctionCall) continue;
    const auto entry = m_entries.find(each.operands[0]);
    if (entry == m_entries.end() || m_runs[entry->second]) continue;
    m_runs[entry->second] = changed = true;
  }
  std::vector<std::uint32_t> targets = findTargets(index);
  if (targets != m_targets[index]) {
    m_targets[index] = std::move(targets);
    changed = true;
    for (const std::uint32_t label : m_targets[index]) m_runs[m_module.blockOf(label)] = true;
  }
  return changed;
}

bool SpirvValues::evaluatePhi(const SpirvInstruction& phi, std::uint32_t label) {
  bool changed = false;
  for (std::size_t i = 0; i + 1 < phi.operands.size(); i += 2) {
    const std::uint32_t value = phi.operands[i];
    if (canGo(phi.operands[i + 1], label) && stateOf(value) != State::unseen)
      changed |= set(phi.result, stateOf(value), valueOf(value).value_or(0));
  }
  return changed;
}

bool SpirvValues::evaluate(const SpirvInstruction& instruction, std::uint32_t label) {
  if (instruction.opcode == spv::OpPhi && isScalar(instruction.type)) return evaluatePhi(instruction, label);
  constexpr std::size_t kMost = 3;
  if (!hasOnlyIds(instruction.opcode) || instruction.operands.size() > kMost || !isScalar(instruction.type))
    return set(instruction.result, State::varying);
  std::array<std::optional<std::uint32_t>, kMost> operands;
  bool isSeen = true;
  for (std::size_t i = 0; i < instruction.operands.size(); ++i) {
    const std::uint32_t id = instruction.operands[i];
    operands[i] = valueOf(id);
    isSeen = isSeen && stateOf(id) != State::unseen;
  }
  const std::optional<std::uint32_t> folded =
      foldSpirv(instruction.opcode, std::span(operands).first(instruction.operands.size()));
  if (folded) return set(instruction.result, State::known, *folded);
  return isSeen && set(instruction.result, State::varying);
}

std::vector<std::uint32_t> SpirvValues::findTargets(std::size_t index) const {
  const SpirvBlock& block = m_module.blocks()[index];
  if (block.successors.size() < 2) return block.successors;
  // A branch to an earlier block stays whole: it is a loop's only way back, and its header must have one.
  const auto leadsBack = [&](std::uint32_t label) { return m_module.blockOf(label) <= index; };
  if (std::ranges::any_of(block.successors, leadsBack)) return block.successors;
  const SpirvInstruction& last = m_module.terminatorOf(block);
  const std::uint32_t selector = last.operands[0];
  if (stateOf(selector) == State::unseen) return {};
  if (stateOf(selector) == State::varying) return block.successors;
  const std::uint32_t value = m_values[selector];
  if (last.opcode == spv::OpBranchConditional) return {last.operands[value != 0 ? 1 : 2]};
  for (std::size_t i = 2; i + 1 < last.operands.size(); i += 2)
    if (last.operands[i] == value) return {last.operands[i + 1]};
  return {last.operands[1]};
}

std::optional<std::uint32_t> SpirvValues::valueOf(std::uint32_t id) const {
  return stateOf(id) == State::known ? std::optional(m_values[id]) : std::nullopt;
}

bool SpirvValues::canGo(std::uint32_t from, std::uint32_t to) const {
  const std::size_t block = m_module.blockOf(from);
  return block < m_runs.size() && m_runs[block] && std::ranges::find(m_targets[block], to) != m_targets[block].end();
}

} // namespace parity::gpu
