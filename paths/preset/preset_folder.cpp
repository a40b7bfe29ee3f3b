#include "paths/preset/preset_folder.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/text/nearest.h"
#include "scenes/names.h"
#include "scenes/suite/table_reader.h"

namespace parity::paths {

namespace {

constexpr const char* kSettings = "preset.toml";
constexpr const char* kFormulas = "preset.glsl";
constexpr std::size_t kHashDigits = 12;

struct Registry {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<const PresetFolder>> byFolder; // what this run reads
  std::vector<std::shared_ptr<const PresetFolder>> all;                // pipelines may be made of them: never freed
};

Registry& registry() {
  static Registry all;
  return all;
}

// "./mypreset" and "0123456789ab"; the hash is empty where there is none.
std::pair<std::string, std::string> splitHash(const std::string& text) {
  const std::size_t at = text.rfind('@');
  std::error_code none;
  const bool hasHash = at != std::string::npos && text.size() == at + 1 + kHashDigits &&
                       text.find_first_not_of("0123456789abcdef", at + 1) == std::string::npos &&
                       !std::filesystem::is_directory(text, none);
  std::string folder = hasHash ? text.substr(0, at) : text;
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  return {folder, hasHash ? text.substr(at + 1) : std::string()};
}

std::vector<PresetFolder::File> readFiles(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw base::fileError(folder, "",
                          std::filesystem::exists(folder, error) ? "is no folder; a preset is a folder with preset.toml"
                                                                 : "does not exist");
  std::vector<PresetFolder::File> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    // Editors leave hidden files while they write.
    if (name.starts_with('.') || (name != kSettings && !name.ends_with(".glsl"))) continue;
    if (files.size() == kMaxPresetFiles)
      throw base::fileError(folder, "", fmt::format("has more than {} files", kMaxPresetFiles));
    files.push_back({name, base::readText(entry->path(), kMaxPresetFileBytes)});
  }
  if (error) throw base::fileError(folder, "", "cannot be listed: " + error.message());
  std::ranges::sort(files, {}, &PresetFolder::File::name);
  return files;
}

const std::string* textOf(const std::vector<PresetFolder::File>& files, std::string_view name) {
  const auto found = std::ranges::find(files, name, &PresetFolder::File::name);
  return found == files.end() ? nullptr : &found->text;
}

std::string hashOf(const std::vector<PresetFolder::File>& files) {
  base::Hasher hasher;
  for (const PresetFolder::File& file : files) hasher.add(file.name).add(file.text);
  return hasher.hex().substr(0, kHashDigits);
}

toml::table parse(const std::string& label, const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw base::fileError(label, fmt::format("line {}", error.source().begin.line), std::string(error.description()));
  }
}

std::string nearestOf(const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return base::describeNearest(name, views);
}

} // namespace

PresetFolder::PresetFolder(std::string folder, std::vector<File> files, const PresetHost& host)
    : m_reference(folder + "@" + hashOf(files)), m_folder(std::move(folder)), m_files(std::move(files)), m_host(host) {
  m_text = scenes::cleanName(std::filesystem::path(m_folder).filename().string()) + m_reference.substr(m_folder.size());
  const std::string* const settings = textOf(m_files, kSettings);
  if (!settings)
    throw base::fileError(m_folder, "", "has no preset.toml; 'parity preset new' writes a folder to start from");
  readSettings(*settings);
  findFunctions();
}

void PresetFolder::readSettings(const std::string& text) {
  const std::string label = m_folder + "/" + kSettings;
  const toml::table root = parse(label, text);
  const scenes::TableReader reader(label, root, "a preset", {"path", "base", "knobs"});
  const std::string path = reader.text("path").value_or("mobile");
  if (path != m_host.path)
    throw reader.errorAt(
        "path", fmt::format("'{}' is not the path that it is used for ({})", scenes::cleanName(path), m_host.path));
  if (!m_host.bases.empty()) {
    const std::optional<std::string> base = reader.text("base");
    if (!base)
      throw reader.errorAt(
          "base", fmt::format("is missing; it is the preset to start from: {}", fmt::join(m_host.bases, ", ")));
    if (std::ranges::count(m_host.bases, *base) == 0)
      throw reader.errorAt(
          "base", fmt::format("'{}' is unknown; {}", scenes::cleanName(*base), nearestOf(*base, m_host.bases)));
    m_base = *base;
  } else if (reader.has("base")) {
    throw reader.errorAt("base", fmt::format("the path {} has no presets to start from", m_host.path));
  }
  const toml::table* const knobs = reader.table("knobs", "[knobs]");
  if (!knobs) return;
  std::vector<std::string> keys;
  for (const base::Knob& knob : m_host.knobs) keys.push_back(base::keyOf(knob.id));
  const scenes::TableReader values(label, *knobs, "the knobs of a preset", keys);
  for (const base::Knob& knob : m_host.knobs) {
    const std::string key = base::keyOf(knob.id);
    if (const auto value = values.value(key, knob)) m_knobs[knob.id] = {*value, values.placeOf(key)};
  }
}

// Every function of the user's that is called like one of the path's must be one of them.
void PresetFolder::findFunctions() {
  constexpr std::string_view kPrefix = "preset";
  std::vector<std::string> known;
  for (const PresetFunction& function : m_host.functions) known.push_back(function.name);
  for (const File& file : compiledFiles()) {
    for (const DefinedFunction& defined : definedFunctionsOf(file.text)) {
      if (!defined.name.starts_with(kPrefix)) continue;
      if (std::ranges::count(known, defined.name) == 0)
        throw base::fileError(m_folder + "/" + file.name, fmt::format("line {}", defined.line),
                              fmt::format("the path {} has no function '{}' to define; {}", m_host.path, defined.name,
                                          nearestOf(defined.name, known)));
      if (!defines(defined.name)) m_functions.push_back(defined.name);
    }
  }
  if (m_functions.empty() && textOf(m_files, kFormulas))
    throw base::fileError(
        m_folder + "/" + kFormulas, "",
        fmt::format("defines none of the functions of the path {}: {}", m_host.path, fmt::join(known, ", ")));
  if (!m_functions.empty() && !textOf(m_files, kFormulas))
    throw base::fileError(m_folder, "", "has functions, but no preset.glsl, which is what is compiled");
  for (const auto& [function, needed] : {std::pair("presetEnvironmentBrdfNonmetal", "presetEnvironmentBrdf"),
                                         std::pair("presetLocalLobe", "presetDirectLobe")})
    if (defines(function) && !defines(needed))
      throw base::fileError(m_folder + "/" + kFormulas, "",
                            fmt::format("defines {} without {}, which must be defined, too", function, needed));
}

std::vector<PresetFolder::File> PresetFolder::compiledFiles() const {
  std::vector<File> reached;
  std::vector<std::string> names = {kFormulas};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string* const text = textOf(m_files, names[i]);
    if (!text) continue;
    reached.push_back({names[i], *text});
    for (const std::string& included : includesOf(*text))
      if (std::ranges::count(names, included) == 0) names.push_back(included);
  }
  return reached;
}

bool PresetFolder::defines(std::string_view function) const { return std::ranges::count(m_functions, function) > 0; }

bool namesPresetFolder(const std::string& text) { return text.find('/') != std::string::npos; }

std::string pathOfPresetFolder(const std::string& text) {
  const std::string folder = splitHash(text).first, label = folder + "/" + kSettings;
  const toml::table root = parse(label, base::readText(label, kMaxPresetFileBytes));
  const std::optional<std::string> path = root["path"].value<std::string>();
  return path.value_or("mobile");
}

std::shared_ptr<const PresetFolder> readPresetFolder(const std::string& text, const PresetHost& host) {
  const auto [folder, hash] = splitHash(text);
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  const std::string key = host.path + " " + folder;
  std::shared_ptr<const PresetFolder>& preset = all.byFolder[key];
  if (!preset) {
    std::vector<PresetFolder::File> files = readFiles(folder);
    const std::string content = folder + "@" + hashOf(files);
    for (const auto& earlier : all.all)
      if (earlier->reference() == content && earlier->path() == host.path) preset = earlier;
    if (!preset) {
      const std::shared_ptr<PresetFolder> made(new PresetFolder(folder, std::move(files), host));
      for (const ProgramMacros& macros : host.checked)
        if (!made->functions().empty()) made->program(macros);
      preset = made;
      all.all.push_back(preset);
    }
  }
  if (!hash.empty() && preset->reference() != folder + "@" + hash)
    throw base::fileError(folder, "",
                          fmt::format("has changed since the run began: its hash is {}, expected {}",
                                      preset->reference().substr(folder.size() + 1), hash));
  return preset;
}

std::vector<std::shared_ptr<const PresetFolder>> readPresetFolders(const std::string& path) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  std::vector<std::shared_ptr<const PresetFolder>> of;
  for (const auto& [key, preset] : all.byFolder)
    if (preset && preset->path() == path) of.push_back(preset);
  return of;
}

void forgetPresetFolders() {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  all.byFolder.clear();
}

} // namespace parity::paths
