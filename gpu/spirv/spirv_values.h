// What the values of specialization constants decide in a module: other values, and which blocks run.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gpu/spirv/spirv_module.h"

namespace parity::gpu {

// Sparse conditional constant propagation (Wegman and Zadeck, "Constant Propagation with Conditional Branches", 1991)
// over 32-bit integers and booleans, from the entry points through the functions that they call. Deviation: passes over
// all blocks in their order until nothing changes, without work lists; shaders need two or three. Arguments and results
// of calls are not known, and floating-point values are left to the driver.
class SpirvValues {
public:
  // constants: values of the specialization constants 0, 1, 2, ...; others keep their defaults. The module must
  // outlive this.
  SpirvValues(const SpirvModule& module, std::span<const std::uint32_t> constants);

  // The value of an id, an integer's bits or 0 and 1; nothing where it is not known before the shader runs.
  std::optional<std::uint32_t> valueOf(std::uint32_t id) const;
  // Whether a block can run; by its index in the module's blocks().
  bool runs(std::size_t block) const { return m_runs[block]; }
  // The labels that a block that runs can go to.
  const std::vector<std::uint32_t>& targetsOf(std::size_t block) const { return m_targets[block]; }
  // Whether control can go from the block of one label to that of the other.
  bool canGo(std::uint32_t from, std::uint32_t to) const;

private:
  enum class State : std::uint8_t { unseen, known, varying };
  void setConstants(std::span<const std::uint32_t> constants);
  bool visit(std::size_t block); // true: something changed
  bool evaluate(const SpirvInstruction& instruction, std::uint32_t label);
  bool evaluatePhi(const SpirvInstruction& phi, std::uint32_t label);
  bool set(std::uint32_t id, State state, std::uint32_t value = 0);
  // Of an id that no instruction defines: varying.
  State stateOf(std::uint32_t id) const { return id < m_states.size() ? m_states[id] : State::varying; }
  bool isScalar(std::uint32_t type) const;
  std::vector<std::uint32_t> findTargets(std::size_t block) const;

  const SpirvModule& m_module;
  std::vector<State> m_states; // by id
  std::vector<std::uint32_t> m_values;
  std::vector<bool> m_runs;                                 // by block
  std::unordered_map<std::uint32_t, std::size_t> m_entries; // first blocks of functions
  std::vector<std::vector<std::uint32_t>> m_targets;
};

} // namespace parity::gpu
