// The settings that a sweep tries: each path as it is asked for, and with one knob turned.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/knob/knob.h"
#include "job/paths.h"

namespace parity::sweep {

// Where a knob costs: device time for every pixel; time once, before the first one; or only bits of what is stored,
// which is not timed here.
enum class Stage { shading, preparation, storage };
// "shading", "preparation", "storage".
const std::vector<std::string>& stageKinds();

struct Variant {
  const paths::Path* path = nullptr;
  std::string name = "default"; // what is not as in the path's default
  std::string knob{};           // the one that is turned; empty: none, or several
  Stage stage = Stage::shading; // where that knob costs
  std::string needs{};          // "environment", "directional light", "local light", "texture"; empty: nothing
  std::string sameAs{};         // id of an earlier variant with the same values; empty: none
  job::Settings settings;       // of them those of its path act

  std::string id() const { return path->name() + ": " + name; }
  // Every knob of the path that costs anything, with its value, as the command line has them.
  std::vector<std::pair<std::string, std::string>> knobs() const;
};

// Of each path that the settings name: its default, its sets of knobs (paths::Path::knobSets), then one knob at a time
// by the table of knobs. Throws Error (usage) unless the first of all paths comes first.
std::vector<Variant> makeVariants(const job::Settings& settings);

// Throws Error (usage) for a glob that matches no id of these.
void requireMatches(const std::vector<Variant>& variants, const std::vector<std::string>& globs);

} // namespace parity::sweep
