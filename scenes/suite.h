// The suite file: many scenes with views, light, flags and budgets, for one report (TOML).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/load_options.h"
#include "scenes/view.h"

namespace parity::scenes {

// What of a scene is compared: itself, or each of its materials on a sphere (scenes/material_balls.h).
enum class Subject { scene, ball };

// One [[scene]] table. Paths are relative to the suite file's folder; "builtin:NAME" is taken as it is.
struct SuiteEntry {
  std::string name;  // default: the file's stem; unique
  std::string scene; // file or builtin:NAME
  LoadOptions load;
  Subject subject = Subject::scene;
  std::string environment; // "" = none
  float environmentRotationDeg = 0;
  bool extractSun = true; // bright compact sources of the environment become lights
  std::optional<SunRequest> sun;
  LightScales lightScales;
  Falloff falloff = Falloff::khr; // of its point and spot lights that have no exponent
  std::optional<Fog> fog;
  std::string baked;                  // folder of its baked light; "" = none
  std::vector<glm::vec3> captures;    // where `parity bake` puts its environment captures; none: it finds places
  std::optional<bool> shadows;        // its lights cast them, or not, whatever the run says
  std::optional<int> interreflection; // bounces of light between its surfaces, in the reference; 0..kMaxInterreflection
  std::vector<ViewRequest> views;     // at least one after loading (auto)
  std::vector<std::string> fullyRough; // globs over material names
  std::optional<std::string> budgets;  // path of a budget file for this scene
  std::optional<float> exposureEv;
};

inline constexpr int kMaxInterreflection = 64;

struct Suite {
  std::string name;
  std::optional<std::string> budgets; // default for all scenes
  std::vector<SuiteEntry> entries;
};

// Throws Error (exit 4) with file, line and the key for a syntax error, an unknown key (naming the nearest known one),
// a wrong type, a value out of range, a duplicate name or an empty list of scenes.
Suite loadSuite(const std::filesystem::path& file);

} // namespace parity::scenes
