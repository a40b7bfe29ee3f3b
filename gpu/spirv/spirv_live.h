// Which values of a module somebody needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_values.h"

namespace parity::gpu {

// Instructions in blocks that run and that either have an effect outside of their function or compute what such
// instructions need.
class SpirvLive {
public:
  // Both must outlive this.
  SpirvLive(const SpirvModule& module, const SpirvValues& values);

  // Of an instruction in a block that runs, by its index in the module's instructions().
  bool isNeeded(std::size_t instruction) const;
  // Of what a function's block defines; false, too, where that block does not run.
  bool isNeeded(const SpirvInstruction& definition) const {
    const auto at = static_cast<std::size_t>(&definition - m_module.instructions().data());
    return m_labelOf[at] != 0 && isNeeded(at);
  }

private:
  void findStores();
  bool hasOnlyResult(const SpirvInstruction& instruction) const;
  void need(std::uint32_t id);
  void needOperands(const SpirvInstruction& instruction, std::uint32_t label);
  std::uint32_t localVariableOf(std::uint32_t pointer) const; // 0: not one of a function

  const SpirvModule& m_module;
  const SpirvValues& m_values;
  std::uint32_t m_glsl = 0;                         // the set GLSL.std.450; 0: not imported
  std::vector<bool> m_needed;                       // by id
  std::vector<std::uint32_t> m_labelOf;             // by instruction: the label of its block; 0: does not run
  std::vector<std::vector<std::uint32_t>> m_stores; // by id of a function's variable: indices of the stores into it
  std::vector<std::uint32_t> m_open;                // ids whose operands are still to be needed
};

} // namespace parity::gpu
