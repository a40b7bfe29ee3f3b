#include "job/what_if.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "job/knobs.h"
#include "job/paths.h"
#include "paths/preset/preset_folder.h"

namespace parity::job {

namespace {

constexpr const char* kOption = "--what-if";

std::vector<std::string> presetsOf(const paths::Path& path) {
  const std::string knob = path.presetKnob();
  return knob.empty() ? std::vector<std::string>() : path.knobs().find(knob)->knob.choices;
}

} // namespace

const paths::Path* pathOfPreset(const std::string& preset) {
  for (const paths::Path* path : allPaths())
    if (std::ranges::count(presetsOf(*path), preset) > 0) return path;
  if (paths::namesPresetFolder(preset)) return &pathByName(paths::pathOfPresetFolder(preset));
  return nullptr;
}

std::vector<std::string> presetsOfPaths() {
  std::vector<std::string> all;
  for (const paths::Path* path : allPaths())
    for (const std::string& preset : presetsOf(*path)) all.push_back(preset);
  return all;
}

void setWhatIfs(Settings& settings, const base::KnobValue& value) {
  settings.whatIfs.clear();
  const std::vector<std::string> known = presetsOfPaths();
  for (const std::string& text : value)
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      const std::string given = text.substr(at, end - at);
      const std::string name = paths::namesPresetFolder(given) && std::ranges::count(known, given) == 0
                                   ? given
                                   : known[base::readChoice(given, known)];
      if (std::ranges::count(settings.whatIfs, name, &WhatIfPreset::preset) == 0)
        settings.whatIfs.push_back({name, pathOfPreset(name)->name(), {}, name});
      at = end + 1;
    }
}

std::string pinnedWhatIfs(const Settings& settings) {
  std::vector<std::string> all;
  for (const WhatIfPreset& each : settings.whatIfs) all.push_back(each.pinned);
  return fmt::format("{}", fmt::join(all, ","));
}

std::string whatIfText(const Settings& settings) {
  std::vector<std::string> all;
  for (const WhatIfPreset& each : settings.whatIfs) {
    std::string text = each.preset;
    for (const auto& row : pathByName(each.path).knobs().rows())
      text += fmt::format(" {}={}", row.knob.id, row.text(each.options));
    all.push_back(std::move(text));
  }
  return all.empty() ? "none" : fmt::format("{}", fmt::join(all, "; "));
}

void deriveWhatIfs(Settings& settings, const Settings& plain, const base::GivenKnobs& given) {
  for (WhatIfPreset& each : settings.whatIfs) {
    Settings other = plain;
    knobs().apply(other, base::merged(given, {{pathByName(each.path).folderKnob(), {{each.pinned}, kOption}}}));
    each.options = other.options;
    const paths::Path& path = pathByName(each.path);
    const auto& row = *path.knobs().find(path.folderKnob());
    each.preset = row.text(each.options), each.pinned = row.pinned ? row.pinned(each.options) : each.preset;
  }
}

void requireWhatIfs(const Settings& settings) {
  for (const WhatIfPreset& each : settings.whatIfs) {
    const std::string& name = each.path;
    const paths::Options& options = each.options;
    const auto refuse = [&](const std::string& reason) {
      throw base::Error(base::ExitCode::usage, kOption, "", fmt::format("'{}' {}", each.preset, reason));
    };
    const std::vector<std::string>& compared = settings.pathNames;
    if (std::find(compared.begin() + 1, compared.end(), name) == compared.end())
      refuse(fmt::format("is a preset of '{}', which is not a test path here", name));
    const paths::Path& path = pathByName(name);
    try {
      path.requireSense(options, settings.display);
    } catch (const base::Error& error) {
      refuse("does not go together with other options: " + error.reason());
    }
    if (path.lightNeeds(options) != path.lightNeeds(settings.options))
      refuse("needs the light in another form than this run; compare it in a run of its own");
    if (path.textureBlock(options) != path.textureBlock(settings.options))
      refuse("needs other textures than this run; compare it in a run of its own");
  }
}

} // namespace parity::job
