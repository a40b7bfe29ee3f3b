#include "gpu/spirv/spirv_specialize.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <glslang/SPIRV/spirv.hpp>

#include "base/error.h"
#include "gpu/spirv/spirv_live.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_values.h"

namespace parity::gpu {

namespace {

class SpecializedWriter {
public:
  SpecializedWriter(const SpirvModule& module, std::span<const std::uint32_t> constants)
      : m_module(module), m_constants(constants), m_values(module, constants), m_live(module, m_values),
        m_bound(module.bound()) {
    const auto first = std::ranges::find(module.instructions(), spv::OpFunction, &SpirvInstruction::opcode);
    if (first != module.instructions().end()) m_firstFunctionWord = first->word;
    findUncalled();
  }

  std::vector<std::uint32_t> write() {
    findStubs();
    const std::vector<SpirvInstruction>& all = m_module.instructions();
    m_words.assign(m_module.words().begin(), m_module.words().begin() + kHeaderWords);
    std::size_t i = 0;
    for (; i < all.size() && all[i].opcode != spv::OpFunction; ++i) writeGlobal(all[i]);
    writeNewConstants();
    bool isUncalled = false;
    for (std::size_t block = 0; i < all.size(); ++i) {
      if (all[i].opcode == spv::OpFunction) isUncalled = m_uncalled.contains(all[i].result);
      if (all[i].opcode == spv::OpLabel) {
        writeBlock(block);
        i = m_module.blocks()[block++].end - 1;
      } else if (!isUncalled) {
        copy(all[i]);
      }
    }
    m_words[kBoundWord] = m_bound;
    return std::move(m_words);
  }

private:
  static constexpr std::ptrdiff_t kHeaderWords = 5;
  static constexpr std::size_t kBoundWord = 3;

  // Functions that nothing calls, with their parameters.
  void findUncalled() {
    std::unordered_set<std::uint32_t> functions;
    for (std::size_t block = 0; block < m_module.blocks().size(); ++block)
      if (m_module.blocks()[block].entryOf != 0 && !m_values.runs(block))
        functions.insert(m_module.blocks()[block].entryOf);
    bool isUncalled = false;
    for (const SpirvInstruction& each : m_module.instructions()) {
      if (each.opcode == spv::OpFunction) isUncalled = functions.contains(each.result);
      if (isUncalled && (each.opcode == spv::OpFunction || each.opcode == spv::OpFunctionParameter))
        m_uncalled.insert(each.result);
    }
  }

  // Blocks that no longer run, but that a merge instruction names: they stay, empty.
  void findStubs() {
    for (std::size_t block = 0; block < m_module.blocks().size(); ++block) {
      if (!m_values.runs(block)) continue;
      for (std::size_t i = m_module.blocks()[block].begin; i < m_module.blocks()[block].end; ++i) {
        const SpirvInstruction& each = m_module.instructions()[i];
        const bool isLoop = each.opcode == spv::OpLoopMerge;
        if (!isLoop && (each.opcode != spv::OpSelectionMerge || becomesPlain(block))) continue;
        if (!runs(each.operands[0])) m_stubs.try_emplace(each.operands[0], 0);
        if (!isLoop || runs(each.operands[1])) continue;
        m_stubs[each.operands[1]] = m_module.blocks()[block].label;
        m_stubBack[m_module.blocks()[block].label] = each.operands[1];
      }
    }
  }

  bool runs(std::uint32_t label) const { return m_values.runs(m_module.blockOf(label)); }

  // Whether a branch with a condition goes one way alone. Its merge instruction goes with it, because blocks inside
  // reach the merge block as their own end alone: a branch without a merge instruction leaves loops and switches,
  // nothing else. A switch keeps its merge instruction: blocks in it may leave it from within others.
  bool becomesPlain(std::size_t block) const {
    const SpirvBlock& of = m_module.blocks()[block];
    return m_module.terminatorOf(of).opcode == spv::OpBranchConditional && m_values.targetsOf(block).size() == 1;
  }

  void write(spv::Op opcode, std::initializer_list<std::uint32_t> words) {
    m_words.push_back((static_cast<std::uint32_t>(words.size() + 1) << spv::WordCountShift) | opcode);
    m_words.insert(m_words.end(), words);
  }

  void copy(const SpirvInstruction& each) {
    const std::size_t length = m_module.words()[each.word] >> spv::WordCountShift;
    const auto first = m_module.words().begin() + static_cast<std::ptrdiff_t>(each.word);
    m_words.insert(m_words.end(), first, first + static_cast<std::ptrdiff_t>(length));
  }

  bool isBoolean(std::uint32_t type) const { return m_module.shapeOfType(type).kind == SpirvShape::Kind::boolean; }

  void writeConstant(std::uint32_t type, std::uint32_t id, std::uint32_t value) {
    if (isBoolean(type))
      write(value != 0 ? spv::OpConstantTrue : spv::OpConstantFalse, {type, id});
    else
      write(spv::OpConstant, {type, id, value});
  }

  // Whether a name or decoration of an id still holds: the id is still there, and is no new constant.
  bool keepsNote(const SpirvInstruction& note) const {
    const std::uint32_t id = note.operands[0];
    if (note.opcode == spv::OpDecorate && note.operands[1] == spv::DecorationSpecId) return false;
    const SpirvInstruction* of = m_module.find(id);
    if (!of || !isInFunction(*of)) return true;
    if (of->opcode == spv::OpLabel) return runs(id);
    if (of->opcode == spv::OpFunction || of->opcode == spv::OpFunctionParameter) return !m_uncalled.contains(id);
    return m_live.isNeeded(*of) && !m_values.valueOf(id);
  }

  bool isInFunction(const SpirvInstruction& each) const { return each.word >= m_firstFunctionWord; }

  void writeGlobal(const SpirvInstruction& each) {
    switch (each.opcode) {
    case spv::OpName:
    case spv::OpDecorate:
      if (keepsNote(each)) copy(each);
      return;
    case spv::OpSpecConstant:
    case spv::OpSpecConstantTrue:
    case spv::OpSpecConstantFalse:
    case spv::OpSpecConstantOp:
      if (const auto value = m_values.valueOf(each.result)) return writeConstant(each.type, each.result, *value);
      if (each.opcode == spv::OpSpecConstant) return writeOtherConstant(each);
      copy(each);
      return;
    default:
      copy(each);
    }
  }

  // A specialization constant that is no integer of 32 bits.
  void writeOtherConstant(const SpirvInstruction& each) {
    const std::optional<std::uint32_t> number = m_module.specIdOf(each.result);
    const std::size_t begin = m_words.size();
    copy(each); // the default
    m_words[begin] = (m_words[begin] & ~std::uint32_t{spv::OpCodeMask}) | spv::OpConstant;
    if (!number || *number >= m_constants.size()) return;
    if (m_module.shapeOfType(each.type).bits != 32)
      throw base::Error(base::ExitCode::failed, "SPIR-V", fmt::format("specialization constant {}", *number),
                        "is not of 32 bits");
    m_words.back() = m_constants[*number];
  }

  // Constants for values that are known, and undefined values for the ways back of loops that never run.
  void writeNewConstants() {
    for (std::size_t block = 0; block < m_module.blocks().size(); ++block) {
      if (!m_values.runs(block)) continue;
      for (std::size_t i = m_module.blocks()[block].begin; i < m_module.blocks()[block].end; ++i) {
        const SpirvInstruction& each = m_module.instructions()[i];
        if (each.result == 0 || !m_live.isNeeded(i)) continue;
        if (const auto value = m_values.valueOf(each.result))
          writeConstant(each.type, each.result, *value);
        else if (each.opcode == spv::OpPhi && stubBackOf(m_module.blocks()[block].label) != 0 &&
                 !m_undefined.contains(each.type))
          write(spv::OpUndef, {each.type, m_undefined[each.type] = m_bound++});
      }
    }
  }

  // The empty block that leads back to this header; 0: none.
  std::uint32_t stubBackOf(std::uint32_t header) const {
    const auto found = m_stubBack.find(header);
    return found == m_stubBack.end() ? 0 : found->second;
  }

  void writeBlock(std::size_t index) {
    const SpirvBlock& block = m_module.blocks()[index];
    if (!m_values.runs(index)) {
      const auto stub = m_stubs.find(block.label);
      if (stub == m_stubs.end()) return;
      write(spv::OpLabel, {block.label});
      if (stub->second != 0)
        write(spv::OpBranch, {stub->second});
      else
        write(spv::OpUnreachable, {});
      return;
    }
    write(spv::OpLabel, {block.label});
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (m_live.isNeeded(i)) writeInBlock(m_module.instructions()[i], index);
  }

  void writeInBlock(const SpirvInstruction& each, std::size_t block) {
    if (each.result != 0 && m_values.valueOf(each.result)) return;
    const std::vector<std::uint32_t>& targets = m_values.targetsOf(block);
    switch (each.opcode) {
    case spv::OpPhi:
      return writePhi(each, m_module.blocks()[block].label);
    case spv::OpSelect:
      if (const auto condition = m_values.valueOf(each.operands[0]))
        return write(spv::OpCopyObject, {each.type, each.result, each.operands[*condition != 0 ? 1 : 2]});
      return copy(each);
    case spv::OpSelectionMerge:
      if (!becomesPlain(block)) copy(each);
      return;
    case spv::OpBranchConditional:
      if (becomesPlain(block)) return write(spv::OpBranch, {targets[0]});
      return copy(each);
    case spv::OpSwitch:
      if (m_values.valueOf(each.operands[0]) && targets.size() == 1)
        return write(spv::OpSwitch, {each.operands[0], targets[0]});
      return copy(each);
    default:
      return copy(each);
    }
  }

  void writePhi(const SpirvInstruction& phi, std::uint32_t label) {
    const std::size_t begin = m_words.size();
    write(spv::OpPhi, {phi.type, phi.result});
    for (std::size_t i = 0; i + 1 < phi.operands.size(); i += 2)
      if (m_values.canGo(phi.operands[i + 1], label))
        m_words.insert(m_words.end(), {phi.operands[i], phi.operands[i + 1]});
    if (const std::uint32_t back = stubBackOf(label)) m_words.insert(m_words.end(), {m_undefined.at(phi.type), back});
    m_words[begin] = (static_cast<std::uint32_t>(m_words.size() - begin) << spv::WordCountShift) | spv::OpPhi;
  }

  const SpirvModule& m_module;
  std::span<const std::uint32_t> m_constants;
  SpirvValues m_values;
  SpirvLive m_live;
  std::uint32_t m_bound;
  std::size_t m_firstFunctionWord = SIZE_MAX;
  std::unordered_map<std::uint32_t, std::uint32_t> m_stubs;     // label; where it leads, 0: nowhere
  std::unordered_map<std::uint32_t, std::uint32_t> m_stubBack;  // header; the empty block that leads back to it
  std::unordered_map<std::uint32_t, std::uint32_t> m_undefined; // by type
  std::unordered_set<std::uint32_t> m_uncalled;                 // functions and their parameters
  std::vector<std::uint32_t> m_words;
};

} // namespace

std::vector<std::uint32_t> specializeSpirv(std::span<const std::uint32_t> words,
                                           std::span<const std::uint32_t> constants) {
  const SpirvModule module({words.begin(), words.end()});
  return SpecializedWriter(module, constants).write();
}

} // namespace parity::gpu
