#include "study/explain/switches.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "job/knobs.h"
#include "mobile/options.h"
#include "mobile/path.h"

namespace parity::explain {

namespace {

constexpr const char* kFormulas = "formulas";

struct Candidate {
  const char *name, *value, *words;
};
// What there is to try. Forms of the preset refit, then storage, then overrides that make a material cheaper.
constexpr Candidate kCandidates[] = {
    {kFormulas, "refit", "environment BRDF and direct lobe of refit"},
    {"capture-scale", "occlusion", "reflections scaled by occlusion alone"},
    {"sky-sh", "9", "nine SH coefficients of the sky"},
    {"mobile-parallax", "on", "parallax of baked captures"},
    {"mobile-coat", "refit", "clear coat of refit"},
    {"mobile-sheen", "fit", "sheen"},
    {"mobile-anisotropy", "bent", "anisotropy by a bent normal"},
    {"mobile-iridescence", "tint", "thin films as a tint"},
    {"mobile-transmission", "mixed", "glass with a refracted read"},
    {"mobile-diffuse-transmission", "lambert", "diffuse transmission"},
    {"mobile-local-lights", "on", "four local lights"},
    {"mobile-sun-shadow", "on", "shadow map of the sun"},
    {"mobile-spot-shadow", "on", "shadow map of the brightest spot light"},
    {"capture", "fp16", "reflections stored in 16-bit floats"},
    {"precision", "fp32", "fp32 in place of half"},
    {"mobile-roughness-floor", "0", "no floor of the roughness"},
    {"mobile-target", "rgba16f", "render target of 16-bit floats"},
    {"mobile-textures", "none", "textures as they are"},
    {"mobile-fully-rough", "on", "fully rough"},
    {"mobile-nonmetal", "on", "nonmetal"},
};

const base::KnobRow<job::Settings>* rowOf(const std::string& id) {
  const base::KnobRow<job::Settings>* row = job::knobs().find(id);
  const std::string& path = mobile::path().name();
  return row && std::ranges::count(row->knob.paths, path) > 0 ? row : nullptr;
}

Switch makeSwitch(const std::string& name, const std::string& value) {
  Switch made{.name = name, .value = value, .words = {}, .needs = {}, .knobs = {{name, value}}};
  if (name == kFormulas) {
    const mobile::Options preset = mobile::presetByName(value);
    const auto nameOf = [](const std::vector<std::string>& names, auto of) {
      return names[static_cast<std::size_t>(of)];
    };
    made.knobs = {{"environment-brdf", nameOf(mobile::environmentBrdfNames(), preset.environmentBrdf)},
                  {"direct-lobe", nameOf(mobile::directLobeNames(), preset.directLobe)}};
  } else {
    made.needs = rowOf(name)->knob.needsScene;
    made.cheapens = name == "mobile-fully-rough" || name == "mobile-nonmetal";
  }
  const auto* known = std::ranges::find_if(
      kCandidates, [&](const Candidate& each) { return each.name == name && each.value == value; });
  made.words = known != std::end(kCandidates) ? known->words : name + " " + value;
  return made;
}

bool changes(const Switch& each, const job::Settings& settings) {
  const job::Settings turned = withSwitches(settings, {each}, 1);
  return std::ranges::any_of(each.knobs, [&](const auto& knob) {
    const auto& row = *job::knobs().find(knob.first);
    return row.text(turned) != row.text(settings);
  });
}

} // namespace

std::vector<Switch> proposedSwitches(const job::Settings& settings) {
  std::vector<Switch> proposed;
  for (const Candidate& candidate : kCandidates) {
    const std::string name = candidate.name;
    // Without shadows the high-end path has none either.
    if (name.ends_with("-shadow") && !settings.shadows) continue;
    const Switch each = makeSwitch(name, candidate.value);
    try {
      if (changes(each, settings)) proposed.push_back(each);
    } catch (const base::Error&) { // does not go together with what was given
    }
  }
  return proposed;
}

Switch parseSwitch(const std::string& text, const job::Settings& settings) {
  const auto refuse = [&](const std::string& reason) {
    return base::Error(base::ExitCode::usage, "--switch", text, reason);
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw refuse("is not KNOB=VALUE, such as sky-sh=9");
  const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
  if (name == kFormulas) {
    const std::vector<std::string>& presets = mobile::presetNames();
    if (std::ranges::count(presets, value) == 0)
      throw refuse(
          fmt::format("'{}' is no preset of the mobile path; {}", value,
                      base::describeNearest(value, std::vector<std::string_view>(presets.begin(), presets.end()))));
  } else if (!rowOf(name)) {
    std::vector<std::string_view> known = {kFormulas};
    for (const base::KnobRow<job::Settings>& row : job::knobs().rows())
      if (rowOf(row.knob.id)) known.push_back(row.knob.id);
    throw refuse(
        fmt::format("'{}' is no setting of the mobile path's pictures; {}", name, base::describeNearest(name, known)));
  }
  const Switch made = makeSwitch(name, value);
  if (!changes(made, settings)) throw refuse("is set already");
  return made;
}

job::Settings withSwitches(const job::Settings& settings, const std::vector<Switch>& switches, SwitchMask mask) {
  base::GivenKnobs given;
  for (std::size_t i = 0; i < switches.size(); ++i)
    if ((mask >> i & 1) != 0)
      for (const auto& [id, value] : switches[i].knobs) given[id] = {{value}, "--switch " + switches[i].id()};
  return job::withKnobs(settings, given);
}

std::string namesOf(const std::vector<Switch>& switches, SwitchMask mask) {
  std::string names;
  for (std::size_t i = 0; i < switches.size(); ++i)
    if ((mask >> i & 1) != 0) names += (names.empty() ? "" : " + ") + switches[i].id();
  return names.empty() ? "nothing" : names;
}

} // namespace parity::explain
