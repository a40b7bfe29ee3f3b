// The suite file: many scenes with views, light and budgets, for one report (TOML).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/knob/knob.h"
#include "scenes/view.h"

namespace parity::scenes {

// [[scene.external]]: pictures that another engine has made of the scene's views (docs/own-engine.md).
struct ExternalPictures {
  std::string name; // in reports
  // Files with {scene} and {view} in their paths, or folders, relative to the suite's folder. reference: empty: the
  // pictures are held against the scene's reference path.
  std::string test, reference;
  std::string transfer = "srgb"; // external/transfer.h
  std::string replaces;          // a path that is not compared beside it, or "reference"; empty: none
  std::string calibration;       // its picture of calibration.glb; empty: none
  std::string where;             // of the table, as messages name it
};

// One scene of a suite. A [[scene]] table makes one for each of its files, in each of its environments, with each of
// its presets. Paths are relative to the folder of the file that names them; "builtin:NAME" is taken as it is.
struct SuiteEntry {
  std::string name;                   // unique
  std::string scene;                  // file or builtin:NAME
  base::GivenKnobs defaults;          // [defaults] of the file that it stands in
  base::GivenKnobs given;             // what is said of it alone: by its table, by overrides
  std::vector<glm::vec3> captures;    // where `parity bake` puts its environment captures; none: it finds places
  std::vector<ViewRequest> views;     // at least one (auto)
  std::optional<std::string> budgets; // path of a budget file for this scene
  std::vector<std::string> tags;      // sorted, each once
  std::vector<ExternalPictures> externals = {};
  std::string where; // of its table, as messages name it: "nightly.toml: line 12"
};

struct Suite {
  std::string name;
  std::optional<std::string> budgets; // default for all scenes
  base::GivenKnobs given;             // [defaults]: of scenes that say nothing else
  std::vector<SuiteEntry> entries;    // at least one
};

// What a suite may say of a scene.
struct SuiteKnobs {
  std::vector<base::Knob> knobs;
  std::function<void(const base::Knob&, const base::KnobValue&)> check; // throws KnobError for a value that is refused
};

// The suite of a file and of those that it includes, whose scenes come first. Throws Error (exit 4) with file, line and
// the key for a syntax error, an unknown key (naming the nearest known one), a wrong type, a value out of range, a glob
// that no file matches, an override that no scene matches, two scenes or views of one name, files that include each
// other, and where no scene is left.
Suite loadSuite(const std::filesystem::path& file, const SuiteKnobs& knobs);

} // namespace parity::scenes
