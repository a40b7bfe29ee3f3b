// What a sweep found, as plain data: one entry a scene, one a setting in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/sweep/variants.h"

namespace parity::sweep {

// Repeated measurements, in ms, in the order of the rounds.
struct Times {
  std::vector<double> deviceMs, wallMs, cpuMs; // of shading all surfaces once, without compiling
  double compileMs = 0; // pipelines and the driver's JIT: what the warm-up round took longer than the median
};

// Figures of one region against one image that is held to be right.
struct Errors {
  double flipMean = 0, flipP95 = 0, relMse = 0;
  std::uint64_t nonFinite = 0; // pixels that are NaN or infinite: they count as the worst in the figures
};
// "flip.mean", "flip.p95", "relmse".
const std::vector<std::string>& errorNames();
// By its name, which must be one of those.
double errorOf(const Errors& errors, const std::string& name);

struct RegionErrors {
  std::string name; // of the material; empty: everything that is covered
  std::uint64_t pixels = 0;
  std::optional<Errors> truth; // none where it was not asked for
  Errors first;                // against the default of the first path
};

// Counted from SPIR-V, a pixel's mean (gpu/spirv/spirv_cost.h).
struct Cost {
  double operations = 0, fetches = 0;
  std::uint64_t samplers = 0;
};

struct VariantResult {
  std::string path, name, knob;
  Stage stage = Stage::shading;
  std::vector<std::pair<std::string, std::string>> knobs;
  Times times;
  std::vector<double> prepareMs; // wall time of what the knob prepares; of the stage preparation alone
  Cost cost;
  RegionErrors whole;
  std::vector<RegionErrors> materials; // those that are seen

  std::string id() const { return path + ": " + name; }
};

struct SceneSweep {
  std::string scene, environment, sun;
  int width = 0, height = 0;
  std::uint64_t pixels = 0; // surface samples shaded in each round
  double truthError = 0;    // median relative standard error of the truth's pixels; 0 without it
  std::vector<VariantResult> variants;
  std::vector<std::string> skipped; // knobs that this scene does not need, with the reason
  std::string failure;              // why it could not be measured; empty where it could
};

struct Machine {
  std::string processor, device, driver, deviceKind, simd;
  int threads = 0;
  bool operator==(const Machine&) const = default;
};

struct SweepReport {
  std::string version, commandLine, startedAt;
  Machine machine;
  int rounds = 0;
  std::string figure = "flip.mean"; // by which settings are held against one another, where no budget names another
  std::vector<SceneSweep> scenes;
};

// Whose default the others are held against; "first" where nothing was measured.
std::string firstPathOf(const SweepReport& report);

// A variant by its id, or null.
const VariantResult* findVariant(const SceneSweep& scene, const std::string& id);

} // namespace parity::sweep
