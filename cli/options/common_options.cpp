// The options that the subcommands share, by CLI11.
#include "cli/options/common_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/options/knob_options.h"
#include "cli/options/option_parts.h"
#include "job/knobs.h"

namespace parity::cli {

void addKnobs(CLI::App& app, CommonOptions& common, RawOptions& raw, const std::vector<std::string>& groups,
              const std::vector<std::string>& without) {
  addKnobOptions<job::Settings>(app, job::knobs(), common.settings, raw.knobs, [&](const base::Knob& knob) {
    return std::ranges::count(groups, knob.group) > 0 && std::ranges::count(without, knob.id) == 0;
  });
}

void addViewKnobs(CLI::App& app, RawOptions& raw) {
  addKnobOptions<scenes::ViewRequest>(app, scenes::viewKnobs(), {}, raw.views, [](const base::Knob&) { return true; });
}

void addEnvironments(CLI::App& app, RawOptions& raw) {
  addRepeatableKnob(app, job::knobs().find("env")->knob, raw.knobs, raw.environments);
}

void addSceneList(CLI::App& app, std::vector<std::string>& scenes, std::string& suite, std::vector<std::string>& only) {
  app.add_option("scenes", scenes, "Scene files or builtin:NAME; -: one a line from standard input")
      ->type_name(kSceneFile);
  app.add_option("--suite", suite, "Suite file (TOML): many scenes, with their views and light")
      ->type_name(kFile)
      ->group(kInputGroup)
      ->excludes("scenes");
  addOnlyOption(app, only);
}

void addCsvOption(CLI::App& app, std::string& csv) {
  app.add_option("--csv", csv, "Write all figures as CSV, one line for each material of each view; - for stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);
}

void requireOneOnStdout(const std::string& json, const std::string& csv) {
  if (json == "-" && csv == "-") throw CLI::ValidationError("--csv", "stdout already takes the JSON; give a file");
}

void addRunOptions(CLI::App& app, CommonOptions& common, RawOptions& raw) {
  app.add_option("--device", common.settings.device.name,
                 "Vulkan device: part of its name, or its number from 'parity devices'. Default: the software device")
      ->type_name("DEVICE")
      ->group(kMachineGroup);
  app.add_flag("--validation", raw.validation,
               "Run with the Khronos validation layer; each of its messages is an error")
      ->group(kMachineGroup);
  app.add_option("--threads", common.threads, "CPU threads; 0: all cores")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_option("--cache", raw.cache, "Cache folder. Default: $XDG_CACHE_HOME/parity")
      ->type_name(kFolder)
      ->group(kCacheGroup);
  app.add_option("--cache-size", raw.cacheSize,
                 "Largest size of the cache, such as 500M or 4G. The entries used longest ago are removed first")
      ->type_name("BYTES")
      ->group(kCacheGroup)
      ->capture_default_str();
  app.add_flag("--no-cache", raw.noCache, "Do not use the cache")->group(kCacheGroup);
  app.add_flag("--timings", common.timings, "Print the time of each stage to stderr")->group(kGeneralGroup);
  app.add_flag("-q,--quiet", raw.quiet, "Print errors only, no table; the exit code is the verdict")
      ->group(kGeneralGroup);
}

void addOnlyOption(CLI::App& app, std::vector<std::string>& only) {
  app.add_option("--only", only,
                 "Only these views of the scenes: a glob SCENE/VIEW, or SCENE for all of its views, or\n"
                 "tag:NAME for the scenes of a suite with this tag; repeatable")
      ->type_name("GLOB")
      ->allow_extra_args(false)
      ->group("Scene");
}

void addBudgetsOption(CLI::App& app, CommonOptions& common) {
  app.add_option("--budgets", common.settings.budgets, "Budget file (TOML) instead of the built-in budgets")
      ->type_name(kFile)
      ->group("Verdict");
}

void addPageOptions(CLI::App& app, ReportCommand& report, RawOptions& raw) {
  app.add_flag("--single-file", report.singleFile,
               "Put pictures and script into index.html, so that you can send this one file")
      ->group("Page");
  choose(app.add_option("--pixel-data", raw.pixelData,
                        "all: also write the pixel values; the page's inspector, exposure and threshold need them.\n"
                        "Default: all, but none with --single-file, which they make large"),
         {"all", "none"})
      ->group("Page");
  choose(app.add_option("--pictures", raw.pictures,
                        "Views whose pictures and pixel values are kept: all, those that do not pass, or none"),
         {job::kPicturesNames.begin(), job::kPicturesNames.end()})
      ->group("Page")
      ->capture_default_str();
}

void addSentinelOption(CLI::App& app, ReportCommand& report) {
  app.add_flag("--sentinel", report.sentinel,
               "Compare eight scenes, or 1 % of them, although the cache has their results: others each day\n"
               "(--as-of). One that comes out otherwise is an error")
      ->group(kCacheGroup);
}

void addBenchOption(CLI::App& app, std::string& bench) {
  app.add_option("--bench", bench, "Add the plot of error over time from this bench.json, or from its folder")
      ->type_name(kFile)
      ->group("Page");
}

void settlePage(ReportCommand& report, const RawOptions& raw) {
  report.pixelData = raw.pixelData.empty() ? !report.singleFile : raw.pixelData == "all";
  const auto chosen = std::ranges::find(job::kPicturesNames, raw.pictures);
  report.pictures = static_cast<job::Pictures>(chosen - job::kPicturesNames.begin());
}

void requireNoneOfScene(const RawOptions& raw) {
  for (const auto& [id, given] : raw.knobs)
    if (job::knobs().find(id)->knob.ofScene) throw CLI::ExcludesError("--suite", given.where);
  if (!raw.views.empty()) throw CLI::ExcludesError("--suite", raw.views.begin()->second.where);
}

void settle(const CLI::App& app, CommonOptions& common, const RawOptions& raw, bool isBesideSuite) {
  if (raw.quiet) base::setLogLevel(base::LogLevel::quiet);
  for (const auto& [id, given] : raw.knobs)
    if (given.where != "--" + id && given.where != "--no-" + id)
      base::logInfo(fmt::format("{} is now called --{}", given.where, id));
  if (!isBesideSuite) requireNeeds(app, job::knobs(), raw.knobs);
  job::Settings& s = common.settings;
  s.device.validation |= raw.validation;
  if (!raw.noCache) s.cacheFolder = raw.cache.empty() ? base::defaultCacheFolder() : std::filesystem::path(raw.cache);
  s.cacheBytes = readOption("--cache-size", base::readBytes, raw.cacheSize);
  common.quiet = raw.quiet;
  common.environments = raw.environments;
  common.plain = s;
  common.given = raw.knobs;
  try {
    // Beside a suite each scene is asked whether all that is said of it goes together.
    s = isBesideSuite ? s : job::withKnobs(s, raw.knobs);
    if (isBesideSuite) job::knobs().apply(s, raw.knobs);
    scenes::viewKnobs().apply(common.view, raw.views);
    scenes::requireSense(common.view);
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::usage) throw; // a preset folder
    throw CLI::ValidationError(error.subject(), error.reason());
  }
  if (s.truth && !s.scene.baked.empty())
    throw CLI::ValidationError("--truth", "cannot be combined with --baked: the truth does not use baked light");
  if (common.view.orbit) common.view.name = "orbit " + raw.views.at("orbit").value.at(0);
  if (!common.view.camera.empty()) common.view.name = common.view.camera;
}

void requireSizeFits(const CommonOptions& common, std::size_t pixelBytes) {
  const auto width = static_cast<std::size_t>(common.settings.width);
  const auto height = static_cast<std::size_t>(common.settings.height);
  const std::size_t bytes = width * height * pixelBytes, limit = common.settings.scene.load.maxMemoryBytes;
  if (bytes > limit)
    throw CLI::ValidationError("--size",
                               fmt::format("{}x{} pixels need about {} MiB; the limit is {} MiB (--max-memory)", width,
                                           height, bytes >> 20, limit >> 20));
}

} // namespace parity::cli
