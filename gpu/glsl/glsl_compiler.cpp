#include "gpu/glsl/glsl_compiler.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "base/error.h"

namespace parity::gpu {

namespace {

// Opens nothing but what `find` gives.
class Includer final : public glslang::TShader::Includer {
public:
  explicit Includer(const FindInclude& find) : m_find(find) {}

  IncludeResult* includeLocal(const char* path, const char* includer, std::size_t depth) override {
    return includeSystem(path, includer, depth);
  }
  IncludeResult* includeSystem(const char* path, const char*, std::size_t) override {
    std::optional<IncludedText> found = m_find(path);
    if (!found) return nullptr;
    auto* const kept = new IncludedText(std::move(*found));
    return new IncludeResult(kept->name, kept->text.data(), kept->text.size(), kept);
  }
  void releaseInclude(IncludeResult* result) override {
    if (!result) return;
    delete static_cast<IncludedText*>(result->userData);
    delete result;
  }

private:
  const FindInclude& m_find;
};

struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

// "ERROR: NAME:LINE: reason" of glslang's log; the name may hold colons.
base::Error errorOf(std::string_view log, const std::string& name) {
  constexpr std::string_view kError = "ERROR: ";
  const std::size_t begin = log.find(kError);
  const std::string_view rest = begin == std::string_view::npos ? log : log.substr(begin + kError.size());
  std::string line(rest.substr(0, rest.find('\n')));
  // What goes on in the next line is indented.
  for (std::size_t end = line.size(); end < rest.size() && rest.substr(end).starts_with("\n ");) {
    const std::size_t next = std::min(rest.find('\n', end + 1), rest.size());
    line += rest.substr(end + 1, next - end - 1);
    end = next;
  }
  while (line.ends_with(' ')) line.pop_back();
  for (std::size_t colon = line.find(':'); colon != std::string::npos; colon = line.find(':', colon + 1)) {
    const std::size_t digits = colon + 1, end = line.find_first_not_of("0123456789", digits);
    if (end == digits || end == std::string::npos || line.substr(end, 2) != ": ") continue;
    return {base::ExitCode::failed, line.substr(0, colon), "line " + line.substr(digits, end - digits),
            line.substr(end + 2)};
  }
  return {base::ExitCode::failed, name, "", line};
}

} // namespace

std::vector<std::uint32_t> compileComputeShader(const std::string& text, const std::string& name,
                                                const FindInclude& find) {
  static const Process process;
  glslang::TShader shader(EShLangCompute);
  const char* const texts[] = {text.c_str()};
  const int lengths[] = {static_cast<int>(text.size())};
  const char* const names[] = {name.c_str()};
  shader.setStringsWithLengthsAndNames(texts, lengths, names, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  constexpr int kDefaultVersion = 110;
  Includer includer(find);
  if (!shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages, includer))
    throw errorOf(shader.getInfoLog(), name);
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) throw errorOf(program.getInfoLog(), name);
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  std::vector<std::uint32_t> words;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &options);
  return words;
}

} // namespace parity::gpu
