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

// One [[scene]] table. Paths are relative to the suite file's folder; "builtin:NAME" is taken as it is.
struct SuiteEntry {
  std::string name;                   // default: the file's stem; unique
  std::string scene;                  // file or builtin:NAME
  base::GivenKnobs given;             // what it says of itself
  std::vector<glm::vec3> captures;    // where `parity bake` puts its environment captures; none: it finds places
  std::vector<ViewRequest> views;     // at least one after loading (auto)
  std::optional<std::string> budgets; // path of a budget file for this scene
};

struct Suite {
  std::string name;
  std::optional<std::string> budgets; // default for all scenes
  base::GivenKnobs given;             // [defaults]: of scenes that say nothing else
  std::vector<SuiteEntry> entries;
};

// What a suite may say of a scene.
struct SuiteKnobs {
  std::vector<base::Knob> knobs;
  std::function<void(const base::Knob&, const base::KnobValue&)> check; // throws KnobError for a value that is refused
};

// Throws Error (exit 4) with file, line and the key for a syntax error, an unknown key (naming the nearest known one),
// a wrong type, a value out of range, a duplicate name or an empty list of scenes.
Suite loadSuite(const std::filesystem::path& file, const SuiteKnobs& knobs);

} // namespace parity::scenes
