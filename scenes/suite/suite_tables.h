// One suite file as it is written: its tables, every key known, every value checked.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/suite/suite.h"

namespace parity::scenes {

// A list of values of a knob, a scene for each: `environments`, `presets`.
struct KnobList {
  base::Knob knob;
  std::vector<base::GivenKnob> values;
};
using KnobLists = std::vector<KnobList>; // in the order of the knobs

// What [defaults], a scene or an override says of scenes.
struct SceneWords {
  base::GivenKnobs given;
  KnobLists lists;
};

struct SceneTable {
  std::string where, filesWhere;   // as messages name the table, and its key `file` or `files`
  std::vector<std::string> files;  // at least one
  std::optional<std::string> name; // may hold {stem}, {folder}, {file}, {environment}, {preset}
  std::string nameWhere;
  SceneWords words;
  std::vector<base::Knob> listed; // all knobs that may be lists: names may hold their values
  std::vector<glm::vec3> captures;
  std::vector<ViewRequest> views;
  std::optional<std::string> budgets;
  std::vector<std::string> tags;
  std::vector<ExternalPictures> externals = {};
};

// Changes some settings of a view.
struct ViewOverride {
  std::string name, where; // a glob
  bool isUsed = false;
  std::function<void(ViewRequest&)> apply;
};

struct OverrideTable {
  std::string where, scenesWhere;
  std::vector<std::string> scenes; // globs of names, or tag:NAME
  base::GivenKnobs given;
  std::optional<std::string> budgets;
  std::vector<std::string> tags; // added
  std::vector<ViewOverride> views;
};

struct SuiteTables {
  std::string name;
  std::optional<std::string> budgets;
  std::vector<std::pair<std::string, std::string>> include; // file, and where it is named
  SceneWords defaults;
  std::vector<SceneTable> scenes;
  std::vector<OverrideTable> overrides;
};

// Throws as loadSuite does for what a file says by itself.
SuiteTables readSuiteTables(const std::filesystem::path& file, const SuiteKnobs& knobs);

} // namespace parity::scenes
