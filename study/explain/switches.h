// The changes of a path that `parity explain` tries in all combinations: one switch each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "job/settings.h"
#include "paths/path.h"
#include "study/explain/sets.h"

namespace parity::explain {

inline constexpr std::size_t kMaxSwitches = 7; // 128 sets

struct Switch {
  std::string name;          // "formulas", or the id of a knob: "sky-sh"
  std::string value;         // what it sets: "refit", "9"
  std::string words;         // "nine SH coefficients of the sky"
  std::string approximation; // what it takes back: "SH order of the sky"
  std::string needs;         // of the scene, as base::Knob::needsScene has it; empty: nothing
  std::vector<std::pair<std::string, std::string>> knobs; // ids and values
  bool cheapens = false; // an override of quality, which is there to save time: it is no way to look alike

  std::string id() const { return name + "=" + value; }
};

// The second of the settings' two paths, whose switches are turned. Throws Error (usage) where it has none, or there
// are others.
const paths::Path& switchedPath(const job::Settings& settings);

// Of what that path has to try, in its order, all that changes something of these settings: nearer forms first, then
// what makes a material cheaper.
std::vector<Switch> proposedSwitches(const job::Settings& settings);

// "sky-sh=9"; "formulas=PRESET", and other names of paths::Path::changes. Throws Error (usage) for a name
// that is no knob of that path, for a value that it does not take, and for one that the settings have already.
Switch parseSwitch(const std::string& text, const job::Settings& settings);

// The settings with the mask's switches turned. Throws Error (usage) where they do not go together.
job::Settings withSwitches(const job::Settings& settings, const std::vector<Switch>& switches, SwitchMask mask);

// "formulas=refit + sky-sh=9"; "nothing" for 0.
std::string namesOf(const std::vector<Switch>& switches, SwitchMask mask);

} // namespace parity::explain
