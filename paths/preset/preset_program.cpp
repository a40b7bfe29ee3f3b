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

std::set<Binding> bindingsOf(const gpu::SpirvModule& module) {
  std::map<std::uint32_t, Binding> of;
  for (const gpu::SpirvInstruction& i : module.instructions()) {
    if (i.opcode != spv::OpDecorate || i.operands.size() < 3) continue;
    if (i.operands[1] == spv::DecorationDescriptorSet) of[i.operands[0]].first = i.operands[2];
    if (i.operands[1] == spv::DecorationBinding) of[i.operands[0]].second = i.operands[2];
  }
  std::set<Binding> all;
  for (const auto& [id, binding] : of) all.insert(binding);
  return all;
}

// Elements of the largest array that the shader has memory of its own for.
std::uint64_t largestArrayOf(const gpu::SpirvModule& module) {
  std::uint64_t largest = 0;
  for (const gpu::SpirvInstruction& i : module.instructions())
    if (i.opcode == spv::OpTypeArray && i.operands.size() == 2)
      largest = std::max(largest, static_cast<std::uint64_t>(
                                      std::max<std::int64_t>(module.integerConstant(i.operands[1]).value_or(0), 0)));
  return largest;
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
  const gpu::Spirv builtIn = m_host.builtIn(macros);
  const gpu::SpirvModule own(words), before(std::vector<std::uint32_t>(builtIn.begin(), builtIn.end()));
  const std::set<Binding> known = bindingsOf(before);
  for (const auto& [set, binding] : bindingsOf(own))
    if (!known.contains({set, binding}))
      refuse(fmt::format("declares a resource (set {}, binding {}) that the path {} does not have", set, binding,
                         m_host.path));
  const std::uint64_t most = std::max<std::uint64_t>(largestArrayOf(before), kMaxPresetArrayElements);
  if (largestArrayOf(own) > most)
    refuse(fmt::format("has an array of {} elements, expected at most {}", largestArrayOf(own), most));
  // A loop that does not end hangs a device, or the device cuts it off in silence.
  for (const File& file : m_files) {
    const std::size_t line = file.name.ends_with(".glsl") ? lineOfLoop(file.text) : 0;
    if (line == 0) continue;
    const gpu::ShaderCost cost = gpu::costOf(words, m_host.counted);
    const auto refuseLoop = [&](const std::string& reason) {
      throw base::fileError(m_folder + "/" + file.name, fmt::format("line {}", line), reason);
    };
    if (cost.openLoops > gpu::costOf(builtIn, m_host.counted).openLoops)
      refuseLoop("a loop from here on has no number of turns that is known before it runs; use 'for' with constants");
    if (cost.operations() > kMaxPresetOperations)
      refuseLoop(fmt::format("with the loops from here on a pixel takes {} operations, expected at most {}",
                             cost.operations(), kMaxPresetOperations));
    return;
  }
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
  const gpu::FindInclude find = [&](std::string_view path) -> std::optional<gpu::IncludedText> {
    for (const std::vector<gpu::ShaderText>* texts : {&gpu::sharedShaderTexts(), &host.texts})
      for (const gpu::ShaderText& text : *texts)
        if (text.path == path) return gpu::IncludedText{std::string(path), std::string(text.text)};
    if (folder)
      for (const PresetFolder::File& file : folder->m_files)
        if (file.name == path) return gpu::IncludedText{folder->m_folder + "/" + file.name, file.text};
    return std::nullopt;
  };
  try {
    return gpu::compileComputeShader(root, folder ? folder->m_folder : host.root, find);
  } catch (const base::Error& error) {
    // A prototype that nothing defines: the function is there with other parameters.
    if (folder && error.reason().find("No function definition (body) found") != std::string::npos)
      for (const PresetFunction& function : host.functions) {
        if (error.reason().find(function.name + "(") == std::string::npos) continue;
        for (const PresetFolder::File& file : folder->m_files)
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
