// A SPIR-V module taken apart: instructions with their types and results, blocks, and how often loops run.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace parity::gpu {

// One instruction (SPIR-V 2.3). Ids are 0 where it has none.
struct SpirvInstruction {
  std::uint32_t opcode = 0; // spv::Op
  std::uint32_t type = 0, result = 0;
  std::span<const std::uint32_t> operands; // what follows type and result; of the module's words
  std::size_t word = 0;                    // where it begins in them
};

// What a value is made of.
struct SpirvShape {
  enum class Kind { real, integer, boolean, other } kind = Kind::other;
  std::uint32_t bits = 0;           // of a number
  std::uint64_t rows = 1, cols = 1; // scalar 1x1, vector n x 1, matrix
  std::uint64_t components() const { return rows * cols; }
};

// A basic block of a function.
struct SpirvBlock {
  std::uint32_t label = 0;
  std::uint32_t entryOf = 0;      // of the first one of a function: that function; else 0
  std::size_t begin = 0, end = 0; // instructions after the label, the terminator included
  std::vector<std::uint32_t> successors;
  std::uint32_t merge = 0;     // of a loop's header, else 0
  std::size_t loopMergeAt = 0; // its OpLoopMerge, as an index of instructions; of a header alone
};

// OpAccessChain or OpInBoundsAccessChain.
bool isAccessChain(const SpirvInstruction& instruction);

class SpirvModule {
public:
  // Lines of the source text (OpLine) are left out. Throws Error (failed) for words that are no SPIR-V of this
  // machine's byte order: instructions that are too short, blocks without an end, branches to what is no block. What
  // else makes a module valid is not checked.
  explicit SpirvModule(std::vector<std::uint32_t> words);
  SpirvModule(const SpirvModule&) = delete;
  SpirvModule& operator=(const SpirvModule&) = delete;

  const std::vector<std::uint32_t>& words() const { return m_words; }
  const std::vector<SpirvInstruction>& instructions() const { return m_instructions; }
  const std::vector<SpirvBlock>& blocks() const { return m_blocks; }                       // of all functions
  std::uint32_t bound() const { return static_cast<std::uint32_t>(m_definitions.size()); } // ids are below it
  // Index in blocks() of the block with that label; blocks().size(): there is none.
  std::size_t blockOf(std::uint32_t label) const {
    return label < bound() && m_blockOfLabel[label] != kNone ? m_blockOfLabel[label] : m_blocks.size();
  }
  const SpirvInstruction& terminatorOf(const SpirvBlock& block) const { return m_instructions[block.end - 1]; }

  const SpirvInstruction* find(std::uint32_t id) const;                // what defines it; null: nothing
  std::optional<std::uint32_t> specIdOf(std::uint32_t id) const;       // the number of a specialization constant
  bool isBefore(std::uint32_t id, const SpirvInstruction& user) const; // whether the id's definition stands before it
  SpirvShape shapeOfType(std::uint32_t type) const;
  SpirvShape shapeOf(std::uint32_t value) const;                       // by the type of that id
  std::optional<std::int64_t> integerConstant(std::uint32_t id) const; // of 32 bits, by the sign of its type

  // How often the body of the loop with this header runs at most, where its counter begins, steps and ends by
  // constants: a `break` in between does not count. None: not known.
  std::optional<std::uint64_t> tripsOf(const SpirvBlock& header) const;

  // The blocks of the loop with this header, itself among them, as indices of blocks().
  std::vector<std::size_t> blocksOfLoop(const SpirvBlock& header) const;

private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  void findBlocks();

  std::vector<std::uint32_t> m_words;
  std::vector<SpirvInstruction> m_instructions;
  std::vector<SpirvBlock> m_blocks;
  std::unordered_map<std::uint32_t, std::uint32_t> m_specIds;
  std::vector<std::uint32_t> m_definitions, m_blockOfLabel; // by id; kNone: has none
};

} // namespace parity::gpu
