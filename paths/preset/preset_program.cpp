// What of a preset folder becomes a program, and what is refused.
#include <algorithm>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <glslang/SPIRV/spirv.hpp>

#include "base/error.h"
#include "gpu/spirv/spirv_cost.h"
#include "gpu/spirv/spirv_module.h"
#include "paths/preset/preset_folder.h"

namespace parity::paths {

namespace {

using Binding = std::pair<std::uint32_t, std::uint32_t>; // set, binding

// Each as often as it is declared: a second declaration may write where the path reads.
std::multiset<Binding> bindingsOf(const gpu::SpirvModule& module) {
  std::map<std::uint32_t, Binding> of;
  for (const gpu::SpirvInstruction& i : module.instructions()) {
    if (i.opcode != spv::OpDecorate || i.operands.size() < 3) continue;
    if (i.operands[1] == spv::DecorationDescriptorSet) of[i.operands[0]].first = i.operands[2];
    if (i.operands[1] == spv::DecorationBinding) of[i.operands[0]].second = i.operands[2];
  }
  std::multiset<Binding> all;
  for (const auto& [id, binding] : of) all.insert(binding);
  return all;
}

std::size_t countOf(const gpu::SpirvModule& module, std::uint32_t opcode) {
  return static_cast<std::size_t>(std::ranges::count(module.instructions(), opcode, &gpu::SpirvInstruction::opcode));
}

// Specialization constants, variables that a group shares, barriers.
std::size_t countForbidden(const gpu::SpirvModule& module) {
  std::size_t count = 0;
  for (const gpu::SpirvInstruction& i : module.instructions()) {
    count +=
        i.opcode == spv::OpSpecConstant || i.opcode == spv::OpSpecConstantTrue || i.opcode == spv::OpSpecConstantFalse;
    count += i.opcode == spv::OpControlBarrier || i.opcode == spv::OpMemoryBarrier;
    count += i.opcode == spv::OpVariable && i.operands[0] == spv::StorageClassWorkgroup;
  }
  return count;
}

// Elements of a type, arrays in arrays multiplied.
std::uint64_t elementsOf(const gpu::SpirvModule& module, std::uint32_t type) {
  const gpu::SpirvInstruction* const i = module.find(type);
  if (!i) return 1;
  if (i->opcode == spv::OpTypeArray) {
    const std::int64_t length = module.integerConstant(i->operands[1]).value_or(0);
    return elementsOf(module, i->operands[0]) * static_cast<std::uint64_t>(std::max<std::int64_t>(length, 1));
  }
  if (i->opcode != spv::OpTypeStruct) return 1;
  std::uint64_t sum = 0;
  for (const std::uint32_t member : i->operands) sum += elementsOf(module, member);
  return sum;
}

// Elements of all arrays that the shader has memory of its own for.
std::uint64_t arrayElementsOf(const gpu::SpirvModule& module) {
  std::uint64_t sum = 0;
  for (const gpu::SpirvInstruction& i : module.instructions()) {
    if (i.opcode != spv::OpVariable) continue;
    if (i.operands[0] != spv::StorageClassPrivate && i.operands[0] != spv::StorageClassFunction) continue;
    const gpu::SpirvInstruction* const pointer = module.find(i.type);
    if (!pointer || pointer->operands.size() < 2) continue;
    if (const std::uint64_t elements = elementsOf(module, pointer->operands[1]); elements > 1) sum += elements;
  }
  return sum;
}

// The line of the first word of a loop, from 1; 0: there is none.
std::size_t lineOfLoop(const std::string& glsl) {
  static const std::regex loop(R"(\b(for|while|do)\b)");
  const std::string plain = withoutComments(glsl);
  std::smatch found;
  if (!std::regex_search(plain, found, loop)) return 0;
  return static_cast<std::size_t>(std::count(plain.begin(), found[0].first, '\n')) + 1;
}

} // namespace

gpu::Spirv PresetFolder::program(const ProgramMacros& macros) const {
  const std::lock_guard lock(m_mutex);
  const auto found = m_programs.find(macros);
  if (found != m_programs.end()) return found->second;
  std::vector<std::uint32_t> words = compileProgram(m_host, this, macros);
  requireWithinLimits(words, macros);
  return m_programs[macros] = std::move(words);
}

void PresetFolder::requireWithinLimits(const std::vector<std::uint32_t>& words, const ProgramMacros& macros) const {
  const auto refuse = [&](const std::string& reason) { throw base::fileError(m_folder + "/preset.glsl", "", reason); };
  if (words.size() > kMaxPresetWords)
    refuse(fmt::format("makes a program of {} words of SPIR-V, expected at most {}", words.size(), kMaxPresetWords));
  const gpu::Spirv builtIn = m_host.builtIn(macros).written;
  const gpu::SpirvModule own(words), before(std::vector<std::uint32_t>(builtIn.begin(), builtIn.end()));
  std::multiset<Binding> known = bindingsOf(before);
  for (const auto& each : bindingsOf(own)) {
    const auto found = known.find(each);
    if (found == known.end())
      refuse(fmt::format("declares a resource (set {}, binding {}) beside those of the path {}", each.first,
                         each.second, m_host.path));
    known.erase(found);
  }
  if (countForbidden(own) > countForbidden(before))
    refuse("has a specialization constant, a shared variable or a barrier, which presets must not have");
  if (const std::uint64_t elements = arrayElementsOf(own), most = arrayElementsOf(before) + kMaxPresetArrayElements;
      elements > most)
    refuse(fmt::format("has arrays of {} elements, expected at most {}", elements - arrayElementsOf(before),
                       kMaxPresetArrayElements));
  // A loop that does not end hangs a device, or the device cuts it off in silence.
  if (countOf(own, spv::OpLoopMerge) <= countOf(before, spv::OpLoopMerge)) return;
  std::string file = "preset.glsl", place;
  for (const File& each : compiledFiles())
    if (const std::size_t line = lineOfLoop(each.text); line > 0 && place.empty())
      file = each.name, place = fmt::format("line {}", line);
  const gpu::ShaderCost cost = gpu::costOf(words, m_host.counted);
  const auto refuseLoop = [&](const std::string& reason) {
    throw base::fileError(m_folder + "/" + file, place, reason);
  };
  if (cost.openLoops > gpu::costOf(builtIn, m_host.counted).openLoops)
    refuseLoop("a loop from here on has no number of turns that is known before it runs; use 'for' with constants");
  if (cost.operations() > kMaxPresetOperations)
    refuseLoop(fmt::format("with the loops from here on a pixel takes {} operations, expected at most {}",
                           cost.operations(), kMaxPresetOperations));
  if (!m_host.unfolded.empty() && macros == m_host.checked.front()) // once
    requireWithinLimits(compileProgram(m_host, this, m_host.unfolded), m_host.unfolded);
}

gpu::Spirv programOf(const PresetHost& host, const PresetFolder* folder, const ProgramMacros& macros) {
  return folder && !folder->functions().empty() ? folder->program(macros) : host.builtIn(macros).spirv;
}

std::vector<std::uint32_t> compileProgram(const PresetHost& host, const PresetFolder* folder,
                                          const ProgramMacros& macros, const std::string& last) {
  std::string root = "#version 460\n#extension GL_GOOGLE_include_directive : require\n";
  for (const std::string& macro : macros) root += "#define " + macro + "\n";
  if (folder) {
    root += "#define PARITY_PRESET\n";
    for (const PresetFunction& function : host.functions)
      if (folder->defines(function.name)) root += "#define " + function.macro() + "\n";
  }
  root += "#include \"" + host.root + "\"\n";
  if (folder && !folder->functions().empty()) root += "#include \"preset.glsl\"\n";
  if (!last.empty()) root += "#include \"" + last + "\"\n";
  std::size_t included = 0; // of the folder's own: a file may include itself
  const gpu::FindInclude find = [&](std::string_view path) -> std::optional<gpu::IncludedText> {
    for (const std::vector<gpu::ShaderText>* texts : {&gpu::sharedShaderTexts(), &host.texts})
      for (const gpu::ShaderText& text : *texts)
        if (text.path == path) return gpu::IncludedText{std::string(path), std::string(text.text)};
    if (folder)
      for (const PresetFolder::File& file : folder->m_files)
        if (file.name == path && ++included <= kMaxPresetFiles)
          return gpu::IncludedText{folder->m_folder + "/" + file.name, file.text};
    return std::nullopt;
  };
  try {
    return gpu::compileComputeShader(root, folder ? folder->m_folder : host.root, find);
  } catch (const base::Error& error) {
    // A prototype that nothing defines: the function is there with other parameters.
    if (folder && error.reason().find("No function definition (body) found") != std::string::npos)
      for (const PresetFunction& function : host.functions) {
        if (error.reason().find(function.name + "(") == std::string::npos) continue;
        for (const PresetFolder::File& file : folder->compiledFiles())
          for (const DefinedFunction& defined : definedFunctionsOf(file.text))
            if (defined.name == function.name)
              throw base::fileError(
                  folder->m_folder + "/" + file.name, fmt::format("line {}", defined.line),
                  fmt::format("{} has other parameters; expected: {}", function.name, function.prototype));
      }
    if (folder && error.subject() == folder->m_folder) // behind the last line of the folder's text
      throw base::fileError(folder->m_folder + "/preset.glsl", "at the end", error.reason());
    throw;
  }
}

} // namespace parity::paths
