#include "paths/preset/preset_template.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/nearest.h"

namespace parity::paths {

namespace {

// "ue4-2020" and "preset.glsl" of "mobile/presets/ue4-2020/preset.glsl".
std::pair<std::string, std::string> partsOf(std::string_view path) {
  const std::size_t file = path.rfind('/'), folder = path.rfind('/', file - 1);
  return {std::string(path.substr(folder + 1, file - folder - 1)), std::string(path.substr(file + 1))};
}

std::vector<gpu::ShaderText> templateTexts(const PresetHost& host) {
  std::vector<gpu::ShaderText> texts;
  for (const gpu::ShaderText& text : host.texts)
    if (text.path.starts_with(host.path + "/presets/")) texts.push_back(text);
  return texts;
}

} // namespace

std::vector<std::string> presetTemplates(const PresetHost& host) {
  std::vector<std::string> names;
  for (const gpu::ShaderText& text : templateTexts(host))
    if (const std::string name = partsOf(text.path).first; std::ranges::count(names, name) == 0) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

void writePresetTemplate(const PresetHost& host, const std::string& name, const std::string& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) &&
      (!std::filesystem::is_directory(folder, error) || !std::filesystem::is_empty(folder, error)))
    throw base::fileError(folder, "", "exists; name a folder that is new or empty");
  const std::vector<std::string> known = presetTemplates(host);
  if (std::ranges::count(known, name) == 0)
    throw base::Error(base::ExitCode::usage, "--from", name,
                      "unknown; " +
                          base::describeNearest(name, std::vector<std::string_view>(known.begin(), known.end())));
  for (const gpu::ShaderText& text : templateTexts(host))
    if (const auto [of, file] = partsOf(text.path); of == name)
      base::writeText(std::filesystem::path(folder) / file, text.text);
}

std::string describeFunctions(const PresetHost& host) {
  std::string page = fmt::format("### Functions of the path {}\n", host.path);
  for (const PresetFunction& function : host.functions)
    page += fmt::format("\n```glsl\n{}\n```\n\n{}", function.prototype, function.words);
  return page;
}

} // namespace parity::paths
