#include "study/explain/switches.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "job/knobs.h"
#include "job/paths.h"

namespace parity::explain {

namespace {

const base::KnobRow<job::Settings>* rowOf(const paths::Path& path, const std::string& id) {
  const base::KnobRow<job::Settings>* row = job::knobs().find(id);
  return row && std::ranges::count(row->knob.paths, path.name()) > 0 ? row : nullptr;
}

Switch switchOf(const paths::Path::Change& change) {
  Switch made{.name = change.name,
              .value = change.value,
              .words = change.words,
              .approximation = change.approximation,
              .needs = {},
              .knobs = change.values,
              .cheapens = change.cheapens};
  if (change.values.size() == 1) made.needs = job::knobs().find(change.values.front().first)->knob.needsScene;
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

const paths::Path& switchedPath(const job::Settings& settings) {
  const job::PathChoice choice = job::pathsOf(settings);
  if (choice.chosen.size() != 2 || choice.chosen[1]->changes().empty())
    throw base::Error(base::ExitCode::usage, "--paths", fmt::format("{}", fmt::join(settings.pathNames, ",")),
                      "explain turns switches of the second of two paths");
  return *choice.chosen[1];
}

std::vector<Switch> proposedSwitches(const job::Settings& settings) {
  std::vector<Switch> proposed;
  for (const paths::Path::Change& change : switchedPath(settings).changes()) {
    if (!change.proposed || (change.ofShadows && !settings.shadows)) continue;
    const Switch each = switchOf(change);
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
  const paths::Path& path = switchedPath(settings);
  std::optional<Switch> made;
  std::vector<std::string> values, names; // of that name; of all
  for (const paths::Path::Change& change : path.changes()) {
    names.push_back(change.name);
    if (change.name != name) continue;
    values.push_back(change.value);
    if (change.value == value) made = switchOf(change);
  }
  if (const auto* row = rowOf(path, name); !made && row)
    made = switchOf({.name = name,
                     .value = value,
                     .words = row->knob.title + " " + value,
                     .approximation = row->knob.title + " " + row->text(settings),
                     .values = {{name, value}}});
  if (!made) {
    const bool isKnown = !values.empty();
    if (!isKnown)
      for (const base::KnobRow<job::Settings>& row : job::knobs().rows())
        if (rowOf(path, row.knob.id)) names.push_back(row.knob.id);
    const std::vector<std::string>& known = isKnown ? values : names;
    throw refuse(fmt::format(
        "'{}' is no {}; {}", isKnown ? value : name,
        isKnown ? "value of " + name : "setting of the path '" + path.name() + "'",
        base::describeNearest(isKnown ? value : name, std::vector<std::string_view>(known.begin(), known.end()))));
  }
  if (!changes(*made, settings)) throw refuse("is set already");
  return *made;
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
