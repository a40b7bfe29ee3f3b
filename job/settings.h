// What a run is asked to do with a scene, as plain data. job/knobs.h says what of it can be given, and how.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/cache.h"
#include "base/stopwatch.h"
#include "compare/metrics/measure.h"
#include "gpu/device/device_report.h"
#include "gpu/shadows/shadow_options.h"
#include "gpu/surface/material_class.h"
#include "paths/options.h"
#include "reference/shade.h"
#include "scenes/scene_settings.h"

namespace parity::job {

// Which materials are attributed by their terms (compare/metrics/attribution.h): those that fail or cannot be judged,
// or each that is seen, whose views are then rendered with their terms at once.
enum class Attribution { none, overBudget, all };
inline constexpr std::array<const char*, 3> kAttributionNames = {"none", "over-budget", "all"};

// A preset of a path that is measured, too, as if the run had been asked for it.
struct WhatIfPreset {
  std::string preset, path; // its name, and the path's
  paths::Options options;   // as that run's
  std::string pinned;       // the text by which it is read again
};

struct Settings {
  scenes::SceneSettings scene;
  int width = 1024, height = 1024;
  int samples = 1;       // per pixel, 1..64
  float filterWidth = 1; // pixels of the box over which they lie
  float exposureEv = 0;
  std::string display = "sRGB";                                 // base::DisplayTransform::names()
  glm::vec3 background{0.18f};                                  // linear Rec.709, the same in every path
  std::vector<std::string> materials;                           // globs: only these are reported; empty: all
  std::optional<std::string> budgets;                           // budget file; none: built-in defaults
  std::vector<std::string> metrics = compare::defaultMetrics(); // reported, besides what the budgets name
  bool terms = false;
  bool coverage = false;                       // of each view's materials, also where one path alone is rendered
  Attribution attribution = Attribution::none; // `all` needs the terms
  int droppedLights = 0; // of each view, the lights dropped by a path whose effect is measured; 0: not looked at
  std::vector<WhatIfPreset> whatIfs; // each once
  bool costs = false;                // count what each permutation costs
  bool truth = false;                // also hold the paths against the ground truth; needs the terms
  // Names (job/paths.h), two at least: the others are compared with the first.
  std::vector<std::string> pathNames = {"highend", "mobile"};
  paths::Options options;                            // of every path
  gpu::SpecularAa specularAa = gpu::SpecularAa::off; // of all paths
  reference::Options reference;
  bool shadows = false; // of all lights: by shadow maps where a path has them, in the truth by rays
  gpu::ShadowOptions shadowMaps;
  gpu::DeviceOptions device;
  std::optional<std::filesystem::path> cacheFolder; // none: nothing is cached
  std::uintmax_t cacheBytes = base::Cache::kDefaultMaxBytes;

  // A path's options.
  template <typename T> T& of() { return options.of<T>(); }
  template <typename T> const T& of() const { return options.of<T>(); }
};

// Told of progress: what is being done, and how much of the run that is, 0..1. One call at a time.
using Progress = std::function<void(const std::string& what, double done)>;

} // namespace parity::job
