// The options that the subcommands share: scene, view, picture, paths, verdict, machine. Only for the files that know
// CLI11.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"
#include "cli/light_options.h"
#include "cli/load_options.h"
#include "cli/path_options.h"

namespace parity::cli {

std::string defaultMetricList();

// What CLI11 fills in; turned into CommonOptions when all is known.
struct RawOptions {
  std::string size = "1024x1024", sun, orbit, target, background, camera = "auto";
  RawPathOptions paths;
  RawLightOptions light;
  RawLoadOptions load;
  std::string error = "0.5%", scattering = "multiple"; // of the reference
  int interreflection = 0;
  std::string cache, cacheSize = "4G";
  std::string attribution = "over-budget";   // of report and diff
  int droppedLights = 8;                     // of report and diff
  std::string metrics = defaultMetricList(); // comma-separated
  std::string pixelData = "all";
  bool noSunExtraction = false, noCache = false, quiet = false, verbose = false, validation = false;
};

// Scene, view, picture, paths, device, cache, verbosity.
void addCommonOptions(CLI::App& app, CommonOptions& common, RawOptions& raw);
// Of those: what is loaded and what lights it; and device, threads, cache, verbosity.
void addSceneOptions(CLI::App& app, CommonOptions& common, RawOptions& raw);
void addRunOptions(CLI::App& app, CommonOptions& common, RawOptions& raw);
// --material: of report and diff what is reported, of render what is drawn.
void addMaterialOption(CLI::App& app, CommonOptions& common, const char* what);
void addBudgetsOption(CLI::App& app, CommonOptions& common);
// --baked: the folder that `parity bake` has written.
void addBakedOption(CLI::App& app, CommonOptions& common);
// --device and --validation alone.
void addDeviceOptions(CLI::App& app, gpu::DeviceOptions& device, RawOptions& raw);
// What is measured; nothing is by `render`.
void addMetricsOption(CLI::App& app, RawOptions& raw);
// --attribution and --dropped-lights, for report and diff; settled before all else.
void addAttributionOption(CLI::App& app, RawOptions& raw);
void addDroppedLightsOption(CLI::App& app, RawOptions& raw);
void settleAttribution(job::Settings& settings, const RawOptions& raw);
// --costs: what each specialised shader costs.
void addCostsOption(CLI::App& app, CommonOptions& common);
// How the ground truth is made: --error, --scattering.
void addReferenceOptions(CLI::App& app, RawOptions& raw);
// What a report's page holds: --single-file, --pixel-data, --bench.
void addPageOptions(CLI::App& app, ReportCommand& report, RawOptions& raw);
// Light between surfaces, in the ground truth: --interreflection.
void addInterreflectionOption(CLI::App& app, RawOptions& raw);

// --reference, which those need.
void addTruthOptions(CLI::App& app, CommonOptions& common, RawOptions& raw);

// Checks what CLI11 has filled in, and turns it into settings. Throws CLI::ValidationError.
void settle(CommonOptions& common, const RawOptions& raw);

// What a view takes for each pixel of --size at its peak, measured (docs/limits.md): compared by two paths, and drawn
// by one.
inline constexpr std::size_t kComparedPixelBytes = 350, kDrawnPixelBytes = 64;
// After settle(). Throws CLI::ValidationError where that is more than --max-memory.
void requireSizeFits(const CommonOptions& common, std::size_t pixelBytes);

} // namespace parity::cli
