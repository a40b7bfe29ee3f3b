#include "gpu/spirv/spirv_rewriter.h"

#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>

#include <glslang/SPIRV/spirv.hpp>

namespace parity::gpu {

namespace {

constexpr std::ptrdiff_t kHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;

// The name as SPIR-V holds it (2.2.1): with its end, in words of little-endian bytes.
std::vector<std::uint32_t> wordsOf(std::string_view text) {
  std::vector<std::uint32_t> words(text.size() / 4 + 1);
  for (std::size_t i = 0; i < text.size(); ++i)
    words[i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << 8 * (i % 4);
  return words;
}

bool isType(std::uint32_t opcode) { return opcode >= spv::OpTypeVoid && opcode <= spv::OpTypeForwardPointer; }

} // namespace

SpirvRewriter::SpirvRewriter(const SpirvModule& module) : m_module(module), m_bound(module.bound()) {}

SpirvRewriter::Words SpirvRewriter::write(const std::function<bool(const SpirvInstruction&)>& replace) {
  const std::span<const SpirvInstruction> all = m_module.instructions();
  const auto functions = std::ranges::find(all, spv::OpFunction, &SpirvInstruction::opcode);
  for (const SpirvInstruction& each : std::span(functions, all.end()))
    if (!replace(each)) copy(each, m_code);

  Words words(m_module.words().begin(), m_module.words().begin() + kHeaderWords);
  append(words, m_capabilities);
  bool isDecorated = false;
  for (const SpirvInstruction& each : std::span(all.begin(), functions)) {
    if (each.opcode == spv::OpMemoryModel) append(words, m_import);                             // they stand before it
    if (isType(each.opcode) && !std::exchange(isDecorated, true)) append(words, m_decorations); // before all types
    if (each.opcode != spv::OpVariable || !m_redeclared.contains(each.result)) copy(each, words);
  }
  append(words, m_globals);
  append(words, m_code);
  words[kBoundWord] = m_bound;
  return words;
}

std::uint32_t SpirvRewriter::typeOf(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands) {
  Words key = {opcode};
  key.insert(key.end(), operands);
  const auto [known, isNew] = m_types.try_emplace(std::move(key), 0);
  if (!isNew) return known->second;
  const auto found = std::ranges::find_if(m_module.instructions(), [&](const SpirvInstruction& each) {
    return each.opcode == opcode && std::ranges::equal(each.operands, operands);
  });
  return known->second = found != m_module.instructions().end() ? found->result : newType(opcode, operands);
}

std::uint32_t SpirvRewriter::newType(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands) {
  Words words = {m_bound};
  words.insert(words.end(), operands);
  write(m_globals, opcode, words);
  return m_bound++;
}

void SpirvRewriter::decorate(std::uint32_t opcode, std::initializer_list<std::uint32_t> operands) {
  write(m_decorations, opcode, operands);
}

void SpirvRewriter::addCapability(std::uint32_t capability) { write(m_capabilities, spv::OpCapability, {capability}); }

void SpirvRewriter::redeclare(std::uint32_t variable, std::uint32_t type) {
  m_redeclared.insert(variable);
  write(m_globals, spv::OpVariable, {type, variable, m_module.find(variable)->operands[0]});
}

std::uint32_t SpirvRewriter::constantOf(std::uint32_t type, std::uint32_t value) {
  write(m_globals, spv::OpConstant, {type, m_bound, value});
  return m_bound++;
}

std::uint32_t SpirvRewriter::realConstant(float value) {
  return constantOf(typeOf(spv::OpTypeFloat, {32}), std::bit_cast<std::uint32_t>(value));
}

std::uint32_t SpirvRewriter::library() {
  if (m_library != 0) return m_library;
  const Words name = wordsOf("GLSL.std.450");
  const auto found = std::ranges::find_if(m_module.instructions(), [&](const SpirvInstruction& each) {
    return each.opcode == spv::OpExtInstImport && std::ranges::equal(each.operands, name);
  });
  if (found != m_module.instructions().end()) return m_library = found->result;
  Words words = {m_bound};
  append(words, name);
  write(m_import, spv::OpExtInstImport, words);
  return m_library = m_bound++;
}

void SpirvRewriter::emit(std::uint32_t opcode, const Words& operands) { write(m_code, opcode, operands); }

std::uint32_t SpirvRewriter::compute(std::uint32_t opcode, std::uint32_t type,
                                     std::initializer_list<std::uint32_t> operands) {
  Words words = {type, m_bound};
  words.insert(words.end(), operands);
  emit(opcode, words);
  return m_bound++;
}

void SpirvRewriter::keepExact(std::uint32_t result) {
  write(m_decorations, spv::OpDecorate, {result, spv::DecorationNoContraction});
}

void SpirvRewriter::write(Words& words, std::uint32_t opcode, const Words& operands) {
  words.push_back((static_cast<std::uint32_t>(operands.size() + 1) << spv::WordCountShift) | opcode);
  append(words, operands);
}

void SpirvRewriter::copy(const SpirvInstruction& each, Words& words) const {
  const auto first = m_module.words().begin() + static_cast<std::ptrdiff_t>(each.word);
  words.insert(words.end(), first, first + (*first >> spv::WordCountShift));
}

} // namespace parity::gpu
