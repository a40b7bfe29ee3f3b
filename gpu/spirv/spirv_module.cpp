#include "gpu/spirv/spirv_module.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#define SPV_ENABLE_UTILITY_CODE
#include <glslang/SPIRV/spirv.hpp>

#include "base/error.h"

namespace parity::gpu {

namespace {

constexpr std::uint64_t kMostTrips = 1 << 20; // beyond them a loop's count is not known
constexpr std::uint32_t kMostIds = 0x3fffff;  // SPIR-V 2.16, universal limits

// Whether a counter of value `a` against the constant `b` stays in the comparison.
std::optional<bool> compare(std::uint32_t opcode, std::int64_t a, std::int64_t b) {
  switch (opcode) {
  case spv::OpSLessThan:
  case spv::OpULessThan:
    return a < b;
  case spv::OpSLessThanEqual:
  case spv::OpULessThanEqual:
    return a <= b;
  case spv::OpSGreaterThan:
  case spv::OpUGreaterThan:
    return a > b;
  case spv::OpSGreaterThanEqual:
  case spv::OpUGreaterThanEqual:
    return a >= b;
  case spv::OpIEqual:
    return a == b;
  case spv::OpINotEqual:
    return a != b;
  default:
    return std::nullopt;
  }
}

// How many operands an instruction has at least, of those that are looked into.
std::size_t leastOperandsOf(std::uint32_t opcode) {
  switch (opcode) {
  case spv::OpSelect:
  case spv::OpBranchConditional:
  case spv::OpMemberDecorate:
    return 3;
  case spv::OpExtInst:
  case spv::OpEntryPoint:
  case spv::OpStore:
  case spv::OpDecorate:
  case spv::OpSwitch:
  case spv::OpSelectionMerge:
  case spv::OpLoopMerge:
  case spv::OpTypeInt:
  case spv::OpTypeVector:
  case spv::OpTypeMatrix:
  case spv::OpTypeArray:
  case spv::OpTypePointer:
  case spv::OpFOrdEqual:
  case spv::OpFUnordEqual:
  case spv::OpFOrdNotEqual:
  case spv::OpFUnordNotEqual:
  case spv::OpFOrdLessThan:
  case spv::OpFUnordLessThan:
  case spv::OpFOrdGreaterThan:
  case spv::OpFUnordGreaterThan:
  case spv::OpFOrdLessThanEqual:
  case spv::OpFUnordLessThanEqual:
  case spv::OpFOrdGreaterThanEqual:
  case spv::OpFUnordGreaterThanEqual:
    return 2;
  case spv::OpBranch:
  case spv::OpName:
  case spv::OpLoad:
  case spv::OpVariable:
  case spv::OpAccessChain:
  case spv::OpInBoundsAccessChain:
  case spv::OpCopyObject:
  case spv::OpFunctionCall:
  case spv::OpTypeFloat:
  case spv::OpTypeRuntimeArray:
  case spv::OpConstant:
  case spv::OpSpecConstant:
  case spv::OpSpecConstantOp:
    return 1;
  default:
    return 0;
  }
}

bool endsBlock(std::uint32_t opcode) {
  return (opcode >= spv::OpBranch && opcode <= spv::OpUnreachable) || opcode == spv::OpTerminateInvocation;
}

// A loop's counter: a phi of its header.
struct Counter {
  std::uint32_t phi = 0, next = 0; // next: the stepped value
  std::int64_t first = 0, step = 0;
};

std::optional<Counter> counterOf(const SpirvModule& module, const SpirvInstruction& phi) {
  if (phi.operands.size() != 4) return std::nullopt;
  for (const auto& [start, next] :
       {std::pair(phi.operands[0], phi.operands[2]), std::pair(phi.operands[2], phi.operands[0])}) {
    const std::optional<std::int64_t> first = module.integerConstant(start);
    const SpirvInstruction* step = module.find(next);
    if (!first || !step || (step->opcode != spv::OpIAdd && step->opcode != spv::OpISub)) continue;
    const bool isLeft = step->operands[0] == phi.result;
    if (!isLeft && (step->operands[1] != phi.result || step->opcode == spv::OpISub)) continue;
    const std::optional<std::int64_t> by = module.integerConstant(step->operands[isLeft ? 1 : 0]);
    if (by) return Counter{phi.result, next, *first, step->opcode == spv::OpIAdd ? *by : -*by};
  }
  return std::nullopt;
}

// How often the body runs until this condition leaves the loop. leavesWhen: the condition's value at that.
std::optional<std::uint64_t> countTrips(const SpirvModule& module, const Counter& counter, std::uint32_t condition,
                                        bool leavesWhen, bool atEnd) {
  const SpirvInstruction* test = module.find(condition);
  if (test && test->opcode == spv::OpLogicalNot)
    return countTrips(module, counter, test->operands[0], !leavesWhen, atEnd);
  if (!test || test->operands.size() != 2) return std::nullopt;
  const bool isLeft = test->operands[0] == counter.phi || test->operands[0] == counter.next;
  const std::uint32_t value = test->operands[isLeft ? 0 : 1];
  if (value != counter.phi && value != counter.next) return std::nullopt;
  const std::optional<std::int64_t> bound = module.integerConstant(test->operands[isLeft ? 1 : 0]);
  if (!bound) return std::nullopt;
  const bool isNext = value == counter.next;
  std::int64_t i = counter.first + (isNext ? counter.step : 0);
  for (std::uint64_t trips = 0; trips < kMostTrips; ++trips, i += counter.step) {
    const std::optional<bool> holds = isLeft ? compare(test->opcode, i, *bound) : compare(test->opcode, *bound, i);
    if (!holds) return std::nullopt;
    if (*holds == leavesWhen) return trips + (isNext || atEnd ? 1 : 0);
  }
  return std::nullopt;
}

} // namespace

bool isAccessChain(const SpirvInstruction& instruction) {
  return instruction.opcode == spv::OpAccessChain || instruction.opcode == spv::OpInBoundsAccessChain;
}

SpirvModule::SpirvModule(std::vector<std::uint32_t> words) : m_words(std::move(words)) {
  const auto refuse = [](std::size_t word, const char* reason) {
    throw base::Error(base::ExitCode::failed, "SPIR-V", fmt::format("word {}", word), reason);
  };
  if (m_words.size() < 5 || m_words[0] != spv::MagicNumber) refuse(0, "is not where a module begins");
  const std::uint32_t bound = m_words[3];
  if (bound > kMostIds) refuse(3, "more ids than a module can have");
  m_definitions.assign(bound, kNone);
  m_blockOfLabel.assign(bound, kNone);
  for (std::size_t at = 5; at < m_words.size();) {
    const std::uint32_t length = m_words[at] >> spv::WordCountShift;
    if (length == 0 || at + length > m_words.size()) refuse(at, "an instruction of impossible length");
    SpirvInstruction instruction;
    instruction.opcode = m_words[at] & spv::OpCodeMask;
    instruction.word = at;
    bool hasResult = false, hasType = false;
    spv::HasResultAndType(static_cast<spv::Op>(instruction.opcode), &hasResult, &hasType);
    if (instruction.opcode == spv::OpLine || instruction.opcode == spv::OpNoLine) {
      at += length;
      continue;
    }
    std::size_t first = at + 1;
    if (length < 1u + (hasResult ? 1 : 0) + (hasType ? 1 : 0)) refuse(at, "an instruction too short for its result");
    if (hasType) instruction.type = m_words[first++];
    if (hasResult) {
      instruction.result = m_words[first++];
      if (instruction.result >= bound) refuse(at, "an id beyond the bound");
      m_definitions[instruction.result] = static_cast<std::uint32_t>(m_instructions.size());
    }
    instruction.operands = std::span(m_words).subspan(first, at + length - first);
    if (instruction.operands.size() < leastOperandsOf(instruction.opcode))
      refuse(at, "an instruction that is too short");
    if (instruction.opcode == spv::OpDecorate && instruction.operands.size() == 3 &&
        instruction.operands[1] == spv::DecorationSpecId)
      m_specIds[instruction.operands[0]] = instruction.operands[2];
    m_instructions.push_back(instruction);
    at += length;
  }
  findBlocks();
  for (const SpirvBlock& block : m_blocks) {
    if (block.begin == block.end || !endsBlock(terminatorOf(block).opcode)) refuse(0, "a block without an end");
    const SpirvInstruction& last = terminatorOf(block);
    for (const std::uint32_t label : block.successors)
      if (blockOf(label) == m_blocks.size()) refuse(last.word, "a branch to what is no block");
    if (last.opcode == spv::OpSwitch && shapeOf(last.operands[0]).bits > 32) refuse(last.word, "a switch over 64 bits");
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const SpirvInstruction& each = m_instructions[i];
      if (each.opcode != spv::OpLoopMerge && each.opcode != spv::OpSelectionMerge) continue;
      if (blockOf(each.operands[0]) == m_blocks.size() ||
          (each.opcode == spv::OpLoopMerge && blockOf(each.operands[1]) == m_blocks.size()))
        refuse(each.word, "a merge in what is no block");
    }
  }
}

void SpirvModule::findBlocks() {
  std::uint32_t begun = 0;
  for (std::size_t i = 0; i < m_instructions.size(); ++i) {
    const SpirvInstruction& instruction = m_instructions[i];
    const std::span<const std::uint32_t> operands = instruction.operands;
    if (instruction.opcode == spv::OpFunction) begun = instruction.result;
    if (instruction.opcode == spv::OpLabel) {
      m_blockOfLabel[instruction.result] = static_cast<std::uint32_t>(m_blocks.size());
      m_blocks.push_back(
          {.label = instruction.result, .entryOf = begun, .begin = i + 1, .end = i + 1, .successors = {}});
      begun = 0;
      continue;
    }
    if (m_blocks.empty() || instruction.opcode == spv::OpFunction || instruction.opcode == spv::OpFunctionParameter ||
        instruction.opcode == spv::OpFunctionEnd)
      continue;
    SpirvBlock& block = m_blocks.back();
    block.end = i + 1;
    if (instruction.opcode == spv::OpLoopMerge) {
      block.merge = operands[0];
      block.loopMergeAt = i;
    }
    if (instruction.opcode == spv::OpBranch) block.successors = {operands[0]};
    if (instruction.opcode == spv::OpBranchConditional) block.successors = {operands[1], operands[2]};
    if (instruction.opcode == spv::OpSwitch) { // selector, default, then pairs of a 32-bit literal and a label
      block.successors = {operands[1]};
      for (std::size_t k = 3; k < operands.size(); k += 2) block.successors.push_back(operands[k]);
    }
  }
}

const SpirvInstruction* SpirvModule::find(std::uint32_t id) const {
  return id < bound() && m_definitions[id] != kNone ? &m_instructions[m_definitions[id]] : nullptr;
}

std::optional<std::uint32_t> SpirvModule::specIdOf(std::uint32_t id) const {
  const auto found = m_specIds.find(id);
  return found == m_specIds.end() ? std::nullopt : std::optional(found->second);
}

// A damaged module may go in circles.
bool SpirvModule::isBefore(std::uint32_t id, const SpirvInstruction& user) const {
  const SpirvInstruction* definition = find(id);
  return definition && definition->word < user.word;
}

SpirvShape SpirvModule::shapeOfType(std::uint32_t type) const {
  const SpirvInstruction* definition = find(type);
  if (!definition) return {};
  const std::span<const std::uint32_t> operands = definition->operands;
  switch (definition->opcode) {
  case spv::OpTypeFloat:
    return {SpirvShape::Kind::real, operands[0]};
  case spv::OpTypeInt:
    return {SpirvShape::Kind::integer, operands[0]};
  case spv::OpTypeBool:
    return {SpirvShape::Kind::boolean, 1};
  case spv::OpTypeVector: {
    if (!isBefore(operands[0], *definition)) return {};
    SpirvShape shape = shapeOfType(operands[0]);
    shape.rows = operands[1];
    return shape;
  }
  case spv::OpTypeMatrix: {
    if (!isBefore(operands[0], *definition)) return {};
    SpirvShape shape = shapeOfType(operands[0]);
    shape.cols = operands[1];
    return shape;
  }
  default:
    return {};
  }
}

SpirvShape SpirvModule::shapeOf(std::uint32_t value) const {
  const SpirvInstruction* definition = find(value);
  return definition ? shapeOfType(definition->type) : SpirvShape{};
}

std::optional<std::int64_t> SpirvModule::integerConstant(std::uint32_t id) const {
  const SpirvInstruction* constant = find(id);
  if (!constant) return std::nullopt;
  const SpirvInstruction* type = find(constant->type);
  if (!type || type->opcode != spv::OpTypeInt || type->operands[0] != 32) return std::nullopt;
  if (constant->opcode == spv::OpConstantNull) return 0;
  if (constant->opcode != spv::OpConstant) return std::nullopt;
  const std::uint32_t bits = constant->operands[0];
  if (type->operands[1] == 0) return std::int64_t{bits};
  return std::int64_t{static_cast<std::int32_t>(bits)};
}

std::vector<std::size_t> SpirvModule::blocksOfLoop(const SpirvBlock& header) const {
  // Structured control flow leaves a loop by its merge block alone.
  std::vector<std::size_t> found = {blockOf(header.label)};
  for (std::size_t next = 0; next < found.size(); ++next)
    for (const std::uint32_t label : m_blocks[found[next]].successors) {
      const std::size_t block = blockOf(label);
      if (label != header.merge && std::find(found.begin(), found.end(), block) == found.end()) found.push_back(block);
    }
  return found;
}

std::optional<std::uint64_t> SpirvModule::tripsOf(const SpirvBlock& header) const {
  const std::vector<std::size_t> body = blocksOfLoop(header);
  const auto goesTo = [](const SpirvBlock& block, std::uint32_t label) {
    return std::find(block.successors.begin(), block.successors.end(), label) != block.successors.end();
  };
  if (std::none_of(body.begin(), body.end(), [&](std::size_t b) { return goesTo(m_blocks[b], header.label); }))
    return 1; // nothing leads back
  std::optional<std::uint64_t> least;
  for (std::size_t i = header.begin; i < header.end; ++i) {
    if (m_instructions[i].opcode != spv::OpPhi) continue;
    const std::optional<Counter> counter = counterOf(*this, m_instructions[i]);
    if (!counter) continue;
    for (const std::size_t b : body) {
      const SpirvBlock& block = m_blocks[b];
      const SpirvInstruction& last = m_instructions[block.end - 1];
      if (last.opcode != spv::OpBranchConditional || !goesTo(block, header.merge)) continue;
      const std::optional<std::uint64_t> trips =
          countTrips(*this, *counter, last.operands[0], last.operands[1] == header.merge, goesTo(block, header.label));
      if (trips && (!least || *trips < *least)) least = trips;
    }
  }
  return least;
}

} // namespace parity::gpu
