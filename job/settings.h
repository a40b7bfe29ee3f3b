// What a run is asked to do: the command line's common options as plain data.
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
#include "base/texture_block.h"
#include "compare/measure.h"
#include "gpu/device_report.h"
#include "gpu/material_class.h"
#include "gpu/output_target.h"
#include "gpu/shadow_options.h"
#include "highend/options.h"
#include "highend/views.h"
#include "mobile/options.h"
#include "mobile/views.h"
#include "reference/shade.h"
#include "scenes/suite.h"

namespace parity::job {

// Which materials are attributed by their terms (compare/attribution.h): those that fail or cannot be judged, or each
// that is seen, whose views are then rendered with their terms at once.
enum class Attribution { none, overBudget, all };
inline constexpr std::array<const char*, 3> kAttributionNames = {"none", "over-budget", "all"};

struct Settings {
  int width = 1024, height = 1024;
  int samples = 1; // per pixel, 1..64
  float exposureEv = 0;
  std::string display = "sRGB";                                 // base::DisplayTransform::names()
  glm::vec3 background{0.18f};                                  // linear Rec.709, the same in every path
  std::vector<std::string> materials;                           // globs: only these are reported; empty: all
  std::vector<std::string> fullyRough;                          // globs: materials given the fully-rough flag
  std::optional<std::string> budgets;                           // budget file; none: built-in defaults
  std::vector<std::string> metrics = compare::defaultMetrics(); // reported, besides what the budgets name
  bool terms = false;
  bool coverage = false;                       // of each view's materials, also where one path alone is rendered
  Attribution attribution = Attribution::none; // `all` needs the terms
  int droppedLights = 0;  // of each view, the lights dropped by mobile whose effect is measured; 0: not looked at
  bool costs = false;     // count what each permutation costs
  bool extractSun = true; // bright compact sources of environments become lights; scene by scene: SuiteEntry
  bool truth = false;     // also hold both paths against the reference; needs the terms
  mobile::Options mobile;
  std::uint32_t highendView = highend::kViewLit; // what the high-end path's colour shows (highend/views.h)
  std::uint32_t mobileView = mobile::kViewLit;   // what the mobile path's colour shows (mobile/views.h)
  gpu::OutputTarget mobileTarget = gpu::OutputTarget::rgba16f;  // what the mobile path's colour is stored in
  base::TextureBlock mobileTextures = base::TextureBlock::none; // what the mobile path's material textures go through
  gpu::SpecularAa specularAa = gpu::SpecularAa::off;            // of all paths
  highend::Options highend;
  reference::Options reference;
  bool shadows = false; // in every scene: high-end by shadow maps, the reference by rays; scene by scene: SuiteEntry
  gpu::ShadowOptions shadowMaps;
  gpu::DeviceOptions device;
  std::optional<std::filesystem::path> cacheFolder; // none: nothing is cached
  std::uintmax_t cacheBytes = base::Cache::kDefaultMaxBytes;
};

// Told of progress: what is being done, and how much of the run that is, 0..1. One call at a time.
using Progress = std::function<void(const std::string& what, double done)>;

} // namespace parity::job
