#include "cli/options/flip_options.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/image/color.h"
#include "base/log.h"
#include "cli/options/common_options.h"
#include "cli/options/option_parts.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_hdr.h"
#include "scenes/scene_settings.h"

namespace parity::cli {

namespace {

// A limit with its name and the place in Threshold that it goes to.
struct LimitOption {
  const char* name;
  const char* help;
  std::vector<double> RawFlipOptions::*values;
  std::optional<double> compare::Threshold::*target;
};
constexpr LimitOption kLimits[] = {
    {"--fail", "Fail if the figure, or any pixel, is beyond this limit", &RawFlipOptions::fail,
     &compare::Threshold::fail},
    {"--failpercent", "Percentage of pixels that may exceed --fail", &RawFlipOptions::failPercent,
     &compare::Threshold::failPercent},
    {"--hardfail", "Fail if a single pixel is beyond this limit", &RawFlipOptions::hardFail,
     &compare::Threshold::hardFail},
    {"--warn", "Warn if the figure, or any pixel, is beyond this limit", &RawFlipOptions::warn,
     &compare::Threshold::warn},
    {"--warnpercent", "Percentage of pixels that may exceed --warn", &RawFlipOptions::warnPercent,
     &compare::Threshold::warnPercent},
    {"--hardwarn", "Warn if a single pixel is beyond this limit", &RawFlipOptions::hardWarn,
     &compare::Threshold::hardWarn},
};

template <typename Names> std::string listNames(const Names& names) { return fmt::format("{}", fmt::join(names, ",")); }

std::vector<std::string> strings(const auto& names) { return {names.begin(), names.end()}; }

void addPictureOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  compare::FlipRequest& request = flip.request;
  std::vector<std::string> spaces = {"auto", "raw"};
  spaces.insert(spaces.end(), base::colorSpaceNames().begin(), base::colorSpaceNames().end());
  choose(app.add_option("--colorspace", request.image.colorSpace,
                        "Colour space of both files; raw: show the values as stored"),
         spaces)
      ->group("Pictures")
      ->capture_default_str();
  choose(app.add_option("--alpha", raw.alpha, "Composite over --background, compare as a separate channel, or ignore"),
         strings(compare::kAlphaModeNames))
      ->group("Pictures")
      ->capture_default_str();
  app.add_option("--background", raw.background, "Colour behind alpha, linear Rec.709 R,G,B. Default 0,0,0")
      ->type_name("R,G,B")
      ->group("Pictures");
  CLI::Option* hdr = app.add_flag("--hdr", raw.hdr, "Compare as HDR, whatever the files hold")->group("Pictures");
  app.add_flag("--ldr", raw.ldr, "Compare as displayed (sRGB, clamped), whatever the files hold")
      ->excludes(hdr)
      ->group("Pictures");
  app.add_flag("--ignore-layers", request.image.ignoreLayers,
               "Compare only the first colour and alpha; other layers and images may differ")
      ->group("Pictures");
  app.add_option("--mask", raw.mask,
                 "Compare by region. The mask holds ids (32-bit floats) or weights (white is inside)")
      ->type_name(kFile)
      ->group("Pictures");
  choose(app.add_option("--mask-kind", raw.maskKind, "Content of the mask"), strings(compare::kMaskKindNames))
      ->group("Pictures")
      ->capture_default_str();
  repeat(app.add_option("--ignore-id", request.mask.ignoredIds, "Ignore this id of the mask (repeatable)"))

      ->group("Pictures");
  app.add_option("--region", raw.region, "X,Y,WIDTH,HEIGHT: compare only this area")
      ->type_name("X,Y,WIDTH,HEIGHT")
      ->group("Pictures");
  choose(
      app.add_option("--non-finite", raw.nonFinite,
                     "NaN and infinity. error: the pair is an error; worst: count them as the worst error, and fail"),
      {"error", "worst"})
      ->group("Pictures")
      ->capture_default_str();
}

void addSizeOptions(CLI::App& app, RawFlipOptions& raw) {
  app.add_option("--max-image", raw.maxImage, "SIDE or SIDE,MEGAPIXELS: largest picture. Default 16384,256")
      ->type_name("SIDE[,MEGAPIXELS]")
      ->group("Pictures");
  app.add_option("--max-memory", raw.maxMemory,
                 "Memory limit for one pair, computed from its headers, such as 512M. Default 6G")
      ->type_name("BYTES")
      ->group("Pictures");
}

// Of one pair of 8-bit pictures 10900 pixels a side need 6 GiB.
base::ImageLimits limitsOf(const RawFlipOptions& raw) {
  scenes::SceneSettings settings;
  scenes::LoadOptions& load = settings.load;
  load.maxImageTexels = base::kMaxImagePixels;
  load.maxMemoryBytes = std::size_t{6} << 30;
  for (const auto& [id, text] : {std::pair("max-image", raw.maxImage), std::pair("max-memory", raw.maxMemory)}) try {
      if (!text.empty()) scenes::sceneKnobs().find(id)->set(settings, {text});
    } catch (const base::KnobError& error) {
      throw CLI::ValidationError(std::string("--") + id, error.reason);
    }
  return {.maxSide = load.maxImageSide, .maxPixels = load.maxImageTexels, .maxBytes = load.maxMemoryBytes};
}

void addMetricOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  constexpr double kMost = 1e6;
  std::vector<std::string> names;
  for (const compare::Metric& metric : compare::metricRegistry()) names.push_back(metric.name);
  app.add_option("--metrics", flip.metrics,
                 fmt::format("Metrics to measure. Default {}; for HDR pairs {}.\nAll: {}",
                             listNames(compare::defaultFlipMetrics(false)),
                             listNames(compare::defaultFlipMetrics(true)), listNames(names)))
      ->type_name("NAME,...")
      ->group("Metrics");
  CLI::Option* ppd = app.add_option("--ppd", raw.ppd, "Pixels per degree. Default 67.0206")
                         ->check(within(compare::kMinPixelsPerDegree, compare::kMaxPixelsPerDegree))
                         ->group("Metrics");
  const auto viewing = [&](const char* name, float& value, const char* help) {
    app.add_option(name, value, help)->check(within(1e-6, kMost))->excludes(ppd)->group("Metrics");
  };
  viewing("--distance", raw.distance,
          "Distance from the eye to the screen, metres. Use with the next two instead of --ppd");
  viewing("--resolution-x", raw.resolutionX, "Width of the screen in pixels");
  viewing("--screen-width", raw.screenWidth, "Width of the screen, metres");
  choose(app.add_option("--tonemapper", raw.tonemapper, "Tone curve of HDR-FLIP. Default aces"),
         strings(compare::kTonemapperNames))
      ->group("Metrics");
  compare::HdrFlipOptions& hdr = flip.request.metric.hdr;
  app.add_option("--start-exposure", hdr.start, "First exposure of HDR-FLIP, EV. Default: from the reference")
      ->check(within(-compare::kMaxExposureEv, compare::kMaxExposureEv))
      ->group("Metrics");
  app.add_option("--stop-exposure", hdr.stop, "Last exposure of HDR-FLIP, EV. Default: from the reference")
      ->check(within(-compare::kMaxExposureEv, compare::kMaxExposureEv))
      ->group("Metrics");
  app.add_option("--exposures", hdr.exposures, "Number of exposures, first and last included. Default: one for each EV")
      ->check(wholeWithin(2, compare::kMaxExposures))
      ->group("Metrics");
}

void addLimitOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  repeat(app.add_option("--metric", raw.metric,
                        "Figure (flip.mean) or metric (flip) for the limits after it (repeatable)"))
      ->type_name("NAME")

      ->group("Verdict");
  for (const LimitOption& limit : kLimits)
    repeat(app.add_option(limit.name, raw.*limit.values, limit.help))->group("Verdict");
  app.add_option("--budgets", flip.budgets, "Budget file (TOML): its materials are regions, its scenes are pairs")
      ->type_name(kFile)
      ->group("Verdict");
  app.add_flag("--warn-exit", flip.warnExit, "Exit with 1 if there are only warnings")->group("Verdict");
}

void addOutputOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  app.add_option("-o,--output", raw.map, "FLIP map: .exr or .pfm (values), .png (magma); a folder for many pairs")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--exposure-map", raw.exposureMap, "Map of the worst exposure of an HDR pair, in the same formats")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--histogram", raw.histogram, "Histogram of the map: .svg; a folder for many pairs")
      ->type_name(kFile)
      ->group("Output");
  choose(app.add_option("--map-kind", raw.mapKind, "Format of the maps in a folder"), {"png", "exr", "pfm"})
      ->group("Output")
      ->capture_default_str();
  app.add_option("--json", flip.json, "Write the result as JSON to this file; - for stdout")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--csv", flip.csv, "Write the result as CSV, one line for each region; - for stdout")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--junit", flip.junit, "Write the result as JUnit XML")->type_name(kFile)->group("Output");
  choose(app.add_option("--annotate", raw.annotate, "github: print failures as annotations of GitHub Actions"),
         {"github"})
      ->group("Output");
}

// One Threshold for each --metric with limits behind it, and one for limits before any.
std::vector<compare::Threshold> collectThresholds(const CLI::App& app, const RawFlipOptions& raw) {
  std::vector<compare::Threshold> thresholds;
  std::map<const CLI::Option*, std::size_t> used;
  const CLI::Option* metric = app.get_option("--metric");
  for (const CLI::Option* option : app.parse_order()) {
    const std::size_t index = used[option]++;
    if (option == metric) {
      thresholds.emplace_back();
      thresholds.back().metric = raw.metric.at(index);
      continue;
    }
    for (const LimitOption& limit : kLimits) {
      if (option != app.get_option(limit.name)) continue;
      if (thresholds.empty()) thresholds.emplace_back();
      std::optional<double>& target = thresholds.back().*limit.target;
      if (target) throw CLI::ValidationError(limit.name, "is given twice for one --metric");
      target = (raw.*limit.values).at(index);
      if (!std::isfinite(*target)) throw CLI::ValidationError(limit.name, "is not a finite number");
    }
  }
  return thresholds;
}

void settlePixelsPerDegree(FlipCommand& flip, const RawFlipOptions& raw) {
  if (raw.ppd > 0) flip.request.metric.ppd = raw.ppd;
  const int given = (raw.distance > 0) + (raw.resolutionX > 0) + (raw.screenWidth > 0);
  if (given == 0) return;
  if (given < 3)
    throw CLI::ValidationError("--distance", "give --distance, --resolution-x and --screen-width together");
  const float ppd = compare::pixelsPerDegree(raw.distance, raw.resolutionX, raw.screenWidth);
  if (!(ppd >= compare::kMinPixelsPerDegree && ppd <= compare::kMaxPixelsPerDegree))
    throw CLI::ValidationError("--distance", fmt::format("gives {} pixels per degree; the range is {} to {}", ppd,
                                                         compare::kMinPixelsPerDegree, compare::kMaxPixelsPerDegree));
  flip.request.metric.ppd = ppd;
}

std::size_t indexIn(const auto& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void settleArea(FlipCommand& flip, const RawFlipOptions& raw) {
  if (raw.region.empty()) return;
  const std::string wanted = "an area X,Y,WIDTH,HEIGHT in whole pixels";
  const auto n = readOption("--region", base::readNumbers, raw.region, wanted);
  for (const float v : n)
    if (v != std::floor(v) || v < 0 || v > static_cast<float>(base::kMaxImageSide))
      throw invalid("--region", raw.region, wanted);
  if (n[2] < 1 || n[3] < 1) throw invalid("--region", raw.region, "an area that has pixels");
  flip.request.mask.area =
      compare::Rect{static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3])};
}

void requireFiles(const FlipCommand& flip) {
  const bool two = !flip.reference.empty() && !flip.test.empty();
  if (!flip.pairList.empty() && !flip.reference.empty())
    throw CLI::ValidationError("--pairs", "cannot be combined with a reference and a test image");
  if (flip.pairList.empty() && !two)
    throw CLI::ValidationError(flip.reference.empty() ? "reference" : "test",
                               "is missing: give a reference and a test image, two folders, or --pairs LIST");
  requireOneOnStdout(flip.json, flip.csv);
  if (flip.junit == "-") throw CLI::ValidationError("--junit", "needs a file, not stdout");
}

} // namespace

void addFlipOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  app.add_option("reference", flip.reference, "Reference image or folder")->type_name(kFile);
  app.add_option("test", flip.test, "Test image or folder")->type_name(kFile);
  app.add_option("--pairs", flip.pairList, "List of pairs, instead of two images or folders; - for standard input")
      ->type_name(kFile)
      ->group(kInputGroup);
  addPictureOptions(app, flip, raw);
  addSizeOptions(app, raw);
  addMetricOptions(app, flip, raw);
  addLimitOptions(app, flip, raw);
  addOutputOptions(app, flip, raw);
  app.add_option("--threads", flip.threads, "CPU threads; 0: all cores")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.quiet, "Print errors only, no table; the exit code is the verdict")
      ->group(kGeneralGroup);
}

void settleFlip(const CLI::App& app, FlipCommand& flip, const RawFlipOptions& raw) {
  requireFiles(flip);
  compare::FlipRequest& request = flip.request;
  if (!raw.background.empty()) {
    const auto n = readOption("--background", base::readNumbers, raw.background, std::string("three numbers R,G,B"));
    if (*std::min_element(n.begin(), n.end()) < 0)
      throw invalid("--background", raw.background, "a colour: no channel may be negative");
    std::copy(n.begin(), n.end(), request.image.background.begin());
    if (raw.alpha != "composite") throw CLI::ValidationError("--background", "has no effect with --alpha " + raw.alpha);
  }
  request.image.alpha = static_cast<compare::AlphaMode>(indexIn(compare::kAlphaModeNames, raw.alpha));
  request.image.limits = request.mask.limits = limitsOf(raw);
  request.mask.file = raw.mask;
  request.mask.kind = static_cast<compare::MaskKind>(indexIn(compare::kMaskKindNames, raw.maskKind));
  if (request.mask.file.empty() && (!request.mask.ignoredIds.empty() || raw.maskKind != "auto"))
    throw CLI::ValidationError("--mask", "is missing; --ignore-id and --mask-kind need a mask");
  request.range = raw.hdr   ? compare::DynamicRange::hdr
                  : raw.ldr ? compare::DynamicRange::ldr
                            : compare::DynamicRange::automatic;
  request.worstNonFinite = raw.nonFinite == "worst";
  settleArea(flip, raw);
  settlePixelsPerDegree(flip, raw);
  if (!raw.tonemapper.empty())
    request.metric.hdr.tonemapper =
        static_cast<compare::Tonemapper>(indexIn(compare::kTonemapperNames, raw.tonemapper));
  request.thresholds = collectThresholds(app, raw);
  request.outputs = {raw.map, raw.exposureMap, raw.histogram, "." + raw.mapKind};
  for (const char* option : {"--tonemapper", "--start-exposure", "--stop-exposure", "--exposures"})
    if (app.count(option) > 0) request.hdrOptions.emplace_back(option);
  flip.githubAnnotations = !raw.annotate.empty();
  flip.quiet = raw.quiet;
  if (raw.quiet) base::setLogLevel(base::LogLevel::quiet);
}

} // namespace parity::cli
