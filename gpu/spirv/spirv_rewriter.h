// A SPIR-V module written anew, with instructions of its functions replaced by others.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <set>
#include <vector>

#include "gpu/spirv/spirv_module.h"

namespace parity::gpu {

// Types, constants and instructions get ids of their own, above the module's. The module must outlive it.
class SpirvRewriter {
public:
  using Words = std::vector<std::uint32_t>;

  explicit SpirvRewriter(const SpirvModule& module);

  // The module's words. replace is asked for each instruction of the functions in their order, and returns whether it
  // has written others in its place. To be called once.
  Words write(const std::function<bool(const SpirvInstruction&)>& replace);

  // The type with these operands: the module's, or one that is added. No type is there twice.
  std::uint32_t typeOf(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands);
  // Always a new one: arrays and structs may be there several times, with decorations of their own.
  std::uint32_t newType(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands);
  // Decorates what was added: OpDecorate or OpMemberDecorate.
  void decorate(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands);
  void addCapability(std::uint32_t capability);
  // Gives one of the module's global variables another type, of a pointer. Once for each.
  void redeclare(std::uint32_t variable, std::uint32_t type);
  std::uint32_t newId() { return m_bound++; } // of a result of emit
  // A new constant of a type of 32 bits.
  std::uint32_t constantOf(std::uint32_t type, std::uint32_t value);
  std::uint32_t realConstant(float value); // of 32 bits
  // GLSL.std.450: the module's import, or one that is added.
  std::uint32_t library();

  // To be called by replace only. Writes an instruction, with the operands behind its opcode.
  void emit(std::uint32_t opcode, const Words& operands);
  // The same with a result, whose id it returns.
  std::uint32_t compute(std::uint32_t opcode, std::uint32_t type, std::initializer_list<std::uint32_t> operands);
  // Drivers must not simplify how this result is computed (SPIR-V 2.18.3, NoContraction).
  void keepExact(std::uint32_t result);

private:
  static void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }
  static void write(Words& words, std::uint32_t opcode, const Words& operands);
  void copy(const SpirvInstruction& each, Words& words) const;

  const SpirvModule& m_module;
  std::uint32_t m_bound, m_library = 0;
  std::map<Words, std::uint32_t> m_types; // of typeOf, by opcode and operands
  std::set<std::uint32_t> m_redeclared;   // variables
  Words m_capabilities, m_import, m_decorations, m_globals, m_code;
};

} // namespace parity::gpu
