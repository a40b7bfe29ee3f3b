#include "cli/options/flip_options.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/image/color.h"
#include "base/log.h"
#include "cli/options/option_parts.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_hdr.h"
#include "scenes/scene_settings.h"

namespace parity::cli {

namespace {

constexpr const char* kFlipFooter = R"(
Two folders are matched by relative path, or by stem where that leaves no choice; a picture without counterpart fails (exit 4),
and the others still run; other files are passed over, with a warning. A list has two paths a line, "..." around spaces, # before
comments, relative to the list's folder.

Colour: integers are sRGB, floats linear Rec.709, unless the file or --colorspace says otherwise. A pair is HDR where both files
hold floats and any value is above 1; then hdrflip takes the place of flip. Grey is spread over RGB; channels must be the same.
Files that differ in what they hold beyond that (layers, further images, the place of the pixels in a larger picture, their
orientation) are not comparable; --ignore-layers compares the colour and alpha of the first image alone.
Alpha: both are composited over --background, linear Rec.709 in any case: C + (1-a) B where colour is multiplied by alpha
(OpenEXR, some TIFF), a C + (1-a) B elsewhere (PNG). With --alpha channel, colour is compared as stored, and alpha as a grey
picture in a row of its own.

Limits belong to the --metric before them; without one, to the pair's FLIP, pixel by pixel.
  --metric flip.mean --fail 0.05             a pooled figure: fails above 0.05 (psnr, ssim...: below; bias: in absolute value)
  --metric flip --fail 0.2 --failpercent 1   pixel by pixel, as idiff: fails if more than 1 % of the pixels are over 0.2
  --metric maxabs --fail 0.01 --failpercent 1  likewise by the largest difference of R, G, B, which is idiff's own
  --metric flip --hardfail 0.9               fails if any pixel is over 0.9
  --fail 0.2                                 the same as --metric flip --fail 0.2 --failpercent 0
--warn, --warnpercent and --hardwarn warn in the same way. Every region has to hold all limits; a limit that nothing can be beyond
is an error. Budgets: without a mask a pair is judged by [[whole]] rules, with one each region by [[material]] rules. Without limits
nothing is judged, and any two finite pictures of one size exit with 0. Pixels that are NaN or infinite never pass.
Exit codes: 0 within limits; 1 warnings only (with --warn-exit); 2 over a limit; 3 not comparable; 4 unreadable, missing or not
finite; 64 usage. The highest that applies wins.)";

// A limit with its name and the place in Threshold that it goes to.
struct LimitOption {
  const char* name;
  const char* help;
  std::vector<double> RawFlipOptions::*values;
  std::optional<double> compare::Threshold::*target;
};
constexpr LimitOption kLimits[] = {
    {"--fail", "Fail beyond it: the figure, or any pixel", &RawFlipOptions::fail, &compare::Threshold::fail},
    {"--failpercent", "... but for this percentage of the pixels", &RawFlipOptions::failPercent,
     &compare::Threshold::failPercent},
    {"--hardfail", "Fail where a single pixel is beyond it", &RawFlipOptions::hardFail, &compare::Threshold::hardFail},
    {"--warn", "Warn beyond it: the figure, or any pixel", &RawFlipOptions::warn, &compare::Threshold::warn},
    {"--warnpercent", "... but for this percentage of the pixels", &RawFlipOptions::warnPercent,
     &compare::Threshold::warnPercent},
    {"--hardwarn", "Warn where a single pixel is beyond it", &RawFlipOptions::hardWarn, &compare::Threshold::hardWarn},
};

template <typename Names> std::string listNames(const Names& names) { return fmt::format("{}", fmt::join(names, ",")); }

std::vector<std::string> strings(const auto& names) { return {names.begin(), names.end()}; }

void addPictureOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  compare::FlipRequest& request = flip.request;
  std::vector<std::string> spaces = {"auto", "raw"};
  spaces.insert(spaces.end(), base::colorSpaceNames().begin(), base::colorSpaceNames().end());
  app.add_option("--colorspace", request.image.colorSpace, "What both files hold; raw: shown as stored")
      ->check(CLI::IsMember(spaces))
      ->group("Pictures")
      ->capture_default_str();
  app.add_option("--alpha", raw.alpha, "Composite over --background, compare as a channel of its own, or ignore")
      ->check(CLI::IsMember(strings(compare::kAlphaModeNames)))
      ->group("Pictures")
      ->capture_default_str();
  app.add_option("--background", raw.background, "R,G,B behind alpha, linear Rec.709. Default 0,0,0")
      ->group("Pictures");
  CLI::Option* hdr = app.add_flag("--hdr", raw.hdr, "Compare as HDR, whatever the files hold")->group("Pictures");
  app.add_flag("--ldr", raw.ldr, "Compare as displayed (sRGB, clamped), whatever the files hold")
      ->excludes(hdr)
      ->group("Pictures");
  app.add_flag("--ignore-layers", request.image.ignoreLayers,
               "Layers and images of a file beyond its first colour and alpha may differ")
      ->group("Pictures");
  app.add_option("--mask", raw.mask, "Compare by region: ids (floats, 32 bit) or weights (white is in)")
      ->group("Pictures");
  app.add_option("--mask-kind", raw.maskKind, "How the mask is meant")
      ->check(CLI::IsMember(strings(compare::kMaskKindNames)))
      ->group("Pictures")
      ->capture_default_str();
  app.add_option("--ignore-id", request.mask.ignoredIds, "Leave this id of the mask out (repeatable)")
      ->allow_extra_args(false)
      ->group("Pictures");
  app.add_option("--region", raw.region, "X,Y,WIDTH,HEIGHT: compare only this area")->group("Pictures");
  app.add_option("--non-finite", raw.nonFinite, "NaN and infinity: an error; or counted as the worst error, and failed")
      ->check(CLI::IsMember({"error", "worst"}))
      ->group("Pictures")
      ->capture_default_str();
}

void addSizeOptions(CLI::App& app, RawFlipOptions& raw) {
  app.add_option("--max-image", raw.maxImage, "SIDE or SIDE,MEGAPIXELS: largest picture. Default 16384,256")
      ->group("Pictures");
  app.add_option("--max-memory", raw.maxMemory,
                 "Most that comparing one pair may take, by its headers, such as 512M. Default 6G")
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
                 fmt::format("What is measured. Default {}; of HDR pairs {}.\nAll: {}",
                             listNames(compare::defaultFlipMetrics(false)),
                             listNames(compare::defaultFlipMetrics(true)), listNames(names)))
      ->group("Metrics");
  CLI::Option* ppd = app.add_option("--ppd", raw.ppd, "Pixels per degree. Default 67.0206")
                         ->check(within(compare::kMinPixelsPerDegree, compare::kMaxPixelsPerDegree))
                         ->group("Metrics");
  const auto viewing = [&](const char* name, float& value, const char* help) {
    app.add_option(name, value, help)->check(within(1e-6, kMost))->excludes(ppd)->group("Metrics");
  };
  viewing("--distance", raw.distance, "From the eye to the screen, metres; with the two below instead of --ppd");
  viewing("--resolution-x", raw.resolutionX, "Pixels across the screen");
  viewing("--screen-width", raw.screenWidth, "Width of the screen, metres");
  app.add_option("--tonemapper", raw.tonemapper, "Of HDR-FLIP. Default aces")
      ->check(CLI::IsMember(strings(compare::kTonemapperNames)))
      ->group("Metrics");
  compare::HdrFlipOptions& hdr = flip.request.metric.hdr;
  app.add_option("--start-exposure", hdr.start, "First exposure of HDR-FLIP, EV. Default: by the reference")
      ->check(within(-compare::kMaxExposureEv, compare::kMaxExposureEv))
      ->group("Metrics");
  app.add_option("--stop-exposure", hdr.stop, "Last exposure, EV")
      ->check(within(-compare::kMaxExposureEv, compare::kMaxExposureEv))
      ->group("Metrics");
  app.add_option("--exposures", hdr.exposures, "How many, both included. Default: one a stop")
      ->check(CLI::Range(2, compare::kMaxExposures))
      ->group("Metrics");
}

void addLimitOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  app.add_option("--metric", raw.metric,
                 "Figure (flip.mean) or metric (flip) that the limits behind it are for (repeatable)")
      ->allow_extra_args(false)
      ->group("Verdict");
  for (const LimitOption& limit : kLimits)
    app.add_option(limit.name, raw.*limit.values, limit.help)->allow_extra_args(false)->group("Verdict");
  app.add_option("--budgets", flip.budgets, "Budget file (TOML): regions are materials, pairs scenes")
      ->group("Verdict");
  app.add_flag("--warn-exit", flip.warnExit, "Exit 1 where there are warnings only")->group("Verdict");
}

void addOutputOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  app.add_option("-o,--output", raw.map, "FLIP map: .exr or .pfm (values), .png (magma); a folder for many pairs")
      ->group("Output");
  app.add_option("--exposure-map", raw.exposureMap, "Of HDR pairs, which exposure is worst; likewise")->group("Output");
  app.add_option("--histogram", raw.histogram, "Histogram of the map: .svg; a folder for many pairs")->group("Output");
  app.add_option("--map-kind", raw.mapKind, "Of the maps in a folder")
      ->check(CLI::IsMember({"png", "exr", "pfm"}))
      ->group("Output")
      ->capture_default_str();
  app.add_option("--json", flip.json, "Write the result as JSON there; - for stdout")->group("Output");
  app.add_option("--csv", flip.csv, "... as CSV, a line a region")->group("Output");
  app.add_option("--junit", flip.junit, "... as JUnit XML")->group("Output");
  app.add_option("--annotate", raw.annotate, "github: print failures as annotations of GitHub Actions")
      ->check(CLI::IsMember({"github"}))
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
      if (target) throw CLI::ValidationError(limit.name, "stands twice for one --metric");
      target = (raw.*limit.values).at(index);
      if (!std::isfinite(*target)) throw CLI::ValidationError(limit.name, "is no finite number");
    }
  }
  return thresholds;
}

void settlePixelsPerDegree(FlipCommand& flip, const RawFlipOptions& raw) {
  if (raw.ppd > 0) flip.request.metric.ppd = raw.ppd;
  const int given = (raw.distance > 0) + (raw.resolutionX > 0) + (raw.screenWidth > 0);
  if (given == 0) return;
  if (given < 3) throw CLI::ValidationError("--distance", "needs --resolution-x and --screen-width, and they need it");
  const float ppd = compare::pixelsPerDegree(raw.distance, raw.resolutionX, raw.screenWidth);
  if (!(ppd >= compare::kMinPixelsPerDegree && ppd <= compare::kMaxPixelsPerDegree))
    throw CLI::ValidationError("--distance", fmt::format("makes {} pixels per degree; {} to {} are possible", ppd,
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
  if (flip.json == "-" && flip.csv == "-") throw CLI::ValidationError("--csv", "stdout is taken by --json");
  if (flip.junit == "-") throw CLI::ValidationError("--junit", "goes to a file");
}

} // namespace

void addFlipOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw) {
  app.footer(kFlipFooter);
  app.add_option("reference", flip.reference, "Reference image or folder");
  app.add_option("test", flip.test, "Test image or folder");
  app.add_option("--pairs", flip.pairList, "A list of pairs instead");
  addPictureOptions(app, flip, raw);
  addSizeOptions(app, raw);
  addMetricOptions(app, flip, raw);
  addLimitOptions(app, flip, raw);
  addOutputOptions(app, flip, raw);
  app.add_option("--threads", flip.threads, "CPU threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.quiet, "Errors only: no table, the exit code tells");
}

void settleFlip(const CLI::App& app, FlipCommand& flip, const RawFlipOptions& raw) {
  requireFiles(flip);
  compare::FlipRequest& request = flip.request;
  if (!raw.background.empty()) {
    const auto n = readOption("--background", base::readNumbers, raw.background, std::string("three numbers R,G,B"));
    if (*std::min_element(n.begin(), n.end()) < 0)
      throw invalid("--background", raw.background, "a colour: a channel is negative");
    std::copy(n.begin(), n.end(), request.image.background.begin());
    if (raw.alpha != "composite") throw CLI::ValidationError("--background", "has no part in --alpha " + raw.alpha);
  }
  request.image.alpha = static_cast<compare::AlphaMode>(indexIn(compare::kAlphaModeNames, raw.alpha));
  request.image.limits = request.mask.limits = limitsOf(raw);
  request.mask.file = raw.mask;
  request.mask.kind = static_cast<compare::MaskKind>(indexIn(compare::kMaskKindNames, raw.maskKind));
  if (request.mask.file.empty() && (!request.mask.ignoredIds.empty() || raw.maskKind != "auto"))
    throw CLI::ValidationError("--mask", "is missing, of which --ignore-id and --mask-kind speak");
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
