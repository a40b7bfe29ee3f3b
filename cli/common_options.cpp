// The options that the subcommands share, by CLI11.
#include "cli/common_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/color.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/option_parts.h"
#include "compare/measure.h"

namespace parity::cli {

namespace {

glm::vec3 parseVec3(const std::string& option, const std::string& text, const std::string& wanted) {
  const auto n = parseNumbers(option, text, 3, wanted);
  return {n[0], n[1], n[2]};
}

void parseSize(const std::string& text, job::Settings& settings) {
  const char* const end = text.data() + text.size();
  const auto [x, widthError] = std::from_chars(text.data(), end, settings.width);
  const bool split = widthError == std::errc() && x != end && *x == 'x';
  const auto [tail, heightError] = std::from_chars(split ? x + 1 : end, end, settings.height);
  if (!split || heightError != std::errc() || tail != end || std::min(settings.width, settings.height) < 1 ||
      std::max(settings.width, settings.height) > base::kMaxImageSide)
    throw invalid("--size", text, fmt::format("WIDTHxHEIGHT with sides of 1 to {}", base::kMaxImageSide));
}

std::string metricNames() {
  std::vector<std::string> names;
  for (const compare::Metric& metric : compare::metricRegistry()) names.push_back(metric.name);
  return fmt::format("{}", fmt::join(names, ","));
}

std::vector<std::string> parseMetrics(const std::string& option, const std::string& text) {
  try {
    return compare::parseMetricNames(text, option);
  } catch (const base::Error& error) {
    throw CLI::ValidationError(option, error.place() + ": " + error.reason());
  }
}

} // namespace

std::string defaultMetricList() { return fmt::format("{}", fmt::join(compare::defaultMetrics(), ",")); }

void addDeviceOptions(CLI::App& app, gpu::DeviceOptions& device, RawOptions& raw) {
  app.add_option("--device", device.name,
                 "Vulkan device: part of its name, or its number in 'parity devices'. Default: the software device");
  app.add_flag("--validation", raw.validation, "Run under the Khronos validation layer; any message is an error");
}

void addSceneOptions(CLI::App& app, CommonOptions& common, RawOptions& raw) {
  app.add_option("--env", common.environment, "HDR environment: .hdr, .exr, .pfm or builtin:sky, studio, night, white")
      ->group("Scene");
  app.add_option("--env-rotation", common.environmentRotationDeg, "Turn the environment about +Y, degrees")
      ->check(within(-3600, 3600))
      ->group("Scene");
  app.add_option("--sun", raw.sun, "Add a directional light: AZIMUTH,ELEVATION,LUX (degrees)")->group("Scene");
  app.add_flag("--no-sun-extraction", raw.noSunExtraction,
               "Leave bright compact sources (the sun) in the environment instead of making them lights")
      ->group("Scene");
  addLoadOptions(app, common.load, raw.load);
  addLightOptions(app, raw.light);
}

void addRunOptions(CLI::App& app, CommonOptions& common, RawOptions& raw) {
  addDeviceOptions(app, common.settings.device, raw);
  app.add_option("--threads", common.threads, "CPU threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--cache", raw.cache, "Cache folder. Default: $XDG_CACHE_HOME/parity");
  app.add_option("--cache-size", raw.cacheSize,
                 "Bound of the cache, as 500M or 4G: what was used longest ago goes first")
      ->capture_default_str();
  app.add_flag("--no-cache", raw.noCache, "Neither read nor write the cache");
  app.add_flag("--timings", common.timings, "Print time by stage to stderr");
  app.add_flag("-q,--quiet", raw.quiet, "Errors only: no table either, the verdict is the exit code");
  app.add_flag("-v,--verbose", raw.verbose, "Say more");
}

void addCommonOptions(CLI::App& app, CommonOptions& common, RawOptions& raw) {
  job::Settings& s = common.settings;
  addSceneOptions(app, common, raw);
  app.add_option("--fully-rough", s.fullyRough, "Materials that take the fully-rough shortcut (glob, repeatable)")
      ->group("Scene");
  app.add_option("--camera", raw.camera, "A glTF camera by name or number, or auto")
      ->group("View")
      ->capture_default_str();
  app.add_option("--orbit", raw.orbit, "THETA,PHI,RADIUS: degrees, metres (radius 0 fits the scene)")->group("View");
  app.add_option("--target", raw.target, "X,Y,Z to look at, metres. Default: the centre of the scene")->group("View");
  app.add_option("--fov", common.view.fovYDeg, "Vertical field of view, degrees; a scene's own camera keeps its own")
      ->check(within(1, 170))
      ->group("View")
      ->capture_default_str();
  app.add_option("--size", raw.size, "WIDTHxHEIGHT in pixels")->group("Picture")->capture_default_str();
  app.add_option("--samples", s.samples, "Samples per pixel")
      ->check(CLI::Range(1, 64))
      ->group("Picture")
      ->capture_default_str();
  app.add_option("--exposure", s.exposureEv, "Exposure, EV")
      ->check(within(-32, 32))
      ->group("Picture")
      ->capture_default_str();
  app.add_option("--display", s.display, "Display transform")
      ->check(CLI::IsMember(base::DisplayTransform::names()))
      ->group("Picture")
      ->capture_default_str();
  app.add_option("--background", raw.background, "Linear R,G,B behind the scene, in every path. Default 0.18,0.18,0.18")
      ->group("Picture");
  addPathOptions(app, s, raw.paths);
  addRunOptions(app, common, raw);
}

void addMaterialOption(CLI::App& app, CommonOptions& common, const char* what) {
  app.add_option("--material", common.settings.materials,
                 fmt::format("{} only these materials (glob, repeatable)", what))
      ->group("Picture");
}

void addBudgetsOption(CLI::App& app, CommonOptions& common) {
  app.add_option("--budgets", common.settings.budgets, "Budget file (TOML) instead of the built-in budgets")
      ->group("Verdict");
}

void addBakedOption(CLI::App& app, CommonOptions& common) {
  app.add_option("--baked", common.baked, "Folder of baked light, by 'parity bake'; of several scenes: that of all")
      ->group("Scene");
}

void addMetricsOption(CLI::App& app, RawOptions& raw) {
  app.add_option("--metrics", raw.metrics, "Metrics to report, of " + metricNames())
      ->group("Verdict")
      ->capture_default_str();
}

void addAttributionOption(CLI::App& app, RawOptions& raw) {
  app.add_option("--attribution", raw.attribution,
                 "Name the term that makes these materials differ: over-budget, all or none")
      ->check(CLI::IsMember(std::vector<std::string>(job::kAttributionNames.begin(), job::kAttributionNames.end())))
      ->group("Verdict")
      ->capture_default_str();
}

void addDroppedLightsOption(CLI::App& app, RawOptions& raw) {
  app.add_option("--dropped-lights", raw.droppedLights,
                 "Measure what so many of a view's lights do that mobile drops, the brightest of them; 0: none")
      ->check(CLI::Range(0, 100000))
      ->group("Verdict")
      ->capture_default_str();
}

void settleAttribution(job::Settings& settings, const RawOptions& raw) {
  settings.attribution =
      enumOf<job::Attribution>(raw.attribution, {job::kAttributionNames.begin(), job::kAttributionNames.end()});
  settings.terms |= settings.attribution == job::Attribution::all;
  settings.droppedLights = raw.droppedLights;
}

void addCostsOption(CLI::App& app, CommonOptions& common) {
  app.add_flag("--costs", common.settings.costs,
               "Also count each specialised shader's operations, texture fetches and samplers")
      ->group("Paths");
}

void addReferenceOptions(CLI::App& app, RawOptions& raw) {
  app.add_option("--error", raw.error, "Relative standard error at which a pixel of the reference is done")
      ->group("Reference")
      ->capture_default_str();
  app.add_option("--scattering", raw.scattering, "Light between microfacets: multiple (Kulla-Conty) or single")
      ->check(CLI::IsMember({"multiple", "single"}))
      ->group("Reference")
      ->capture_default_str();
}

void addInterreflectionOption(CLI::App& app, RawOptions& raw) {
  app.add_option("--interreflection", raw.interreflection,
                 "Bounces of light between surfaces in the reference, with shadows; 0: none")
      ->check(CLI::Range(0, scenes::kMaxInterreflection))
      ->group("Reference")
      ->capture_default_str();
}

void addPageOptions(CLI::App& app, ReportCommand& report, RawOptions& raw) {
  app.add_flag("--single-file", report.singleFile,
               "Put all that index.html shows into it: pictures, values, script; then it can be sent alone")
      ->group("Page");
  app.add_option("--pixel-data", raw.pixelData,
                 "all: also write the values behind the pictures, for the page's inspector, exposure and threshold")
      ->check(CLI::IsMember({"all", "none"}))
      ->group("Page")
      ->capture_default_str();
  app.add_option("--bench", report.bench, "Show the error-against-time plot of this bench.json, or of its folder")
      ->group("Page");
}

void addTruthOptions(CLI::App& app, CommonOptions& common, RawOptions& raw) {
  app.add_flag("--reference", common.settings.truth,
               "Also hold both paths against the ground truth, term by term: exact integrals, slow; judges nothing")
      ->group("Reference");
  addReferenceOptions(app, raw);
  addInterreflectionOption(app, raw);
  for (const char* option : {"--error", "--scattering", "--interreflection"})
    app.get_option(option)->needs("--reference");
}

void settle(CommonOptions& common, const RawOptions& raw) {
  job::Settings& s = common.settings;
  s.reference.integral.relativeError = parseShare("--error", raw.error);
  s.reference.model.scattering =
      raw.scattering == "single" ? reference::Scattering::single : reference::Scattering::multiple;
  s.reference.bounces = raw.interreflection;
  parseSize(raw.size, s);
  s.extractSun = !raw.noSunExtraction;
  if (!raw.sun.empty()) {
    const auto n = parseNumbers("--sun", raw.sun, 3, "AZIMUTH,ELEVATION,LUX");
    if (std::abs(n[1]) > 90) throw invalid("--sun", raw.sun, "a place in the sky: ELEVATION is from -90 to 90");
    if (n[2] < 0) throw invalid("--sun", raw.sun, "a light: LUX is negative");
    common.sun = scenes::SunRequest{n[0], n[1], n[2]};
  }
  settleLight(common, raw.light);
  settleLoad(common, raw.load);
  if (!raw.orbit.empty()) {
    const glm::vec3 orbit = parseVec3("--orbit", raw.orbit, "THETA,PHI,RADIUS");
    if (orbit.y < 0 || orbit.y > 180 || orbit.z < 0)
      throw invalid("--orbit", raw.orbit, "an orbit: PHI is from 0 to 180, RADIUS at least 0");
    common.view.orbit = orbit;
  }
  if (!raw.target.empty()) common.view.target = parseVec3("--target", raw.target, "X,Y,Z");
  if (raw.camera != "auto") {
    if (common.view.orbit) throw CLI::ValidationError("--camera", "cannot be combined with --orbit");
    common.view.camera = common.view.name = raw.camera;
  }
  if (common.view.orbit) common.view.name = "orbit " + raw.orbit;
  if (!raw.background.empty()) {
    s.background = parseVec3("--background", raw.background, "three numbers R,G,B");
    if (s.background.x < 0 || s.background.y < 0 || s.background.z < 0)
      throw invalid("--background", raw.background, "a colour: a channel is negative");
  }
  if (s.truth && !common.baked.empty())
    throw CLI::ValidationError("--reference", "cannot be combined with --baked: it knows of no baked light");
  s.terms |= s.truth;
  s.metrics = parseMetrics("--metrics", raw.metrics);
  settlePaths(s, raw.paths);
  s.device.validation |= raw.validation;
  common.quiet = raw.quiet;
  if (!raw.noCache) s.cacheFolder = raw.cache.empty() ? base::defaultCacheFolder() : std::filesystem::path(raw.cache);
  s.cacheBytes = parseBytes("--cache-size", raw.cacheSize);
  base::setLogLevel(raw.quiet ? base::LogLevel::quiet : raw.verbose ? base::LogLevel::verbose : base::LogLevel::normal);
}

void requireSizeFits(const CommonOptions& common, std::size_t pixelBytes) {
  const auto width = static_cast<std::size_t>(common.settings.width);
  const auto height = static_cast<std::size_t>(common.settings.height);
  const std::size_t bytes = width * height * pixelBytes, limit = common.load.maxMemoryBytes;
  if (bytes > limit)
    throw CLI::ValidationError("--size",
                               fmt::format("{}x{} pixels take some {} MiB, the limit is {} MiB (--max-memory)", width,
                                           height, bytes >> 20, limit >> 20));
}

} // namespace parity::cli
