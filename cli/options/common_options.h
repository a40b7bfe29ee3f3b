// The options that the subcommands share: knobs, machine, page, verdict. Only for the files that know CLI11.
#pragma once

#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// What CLI11 fills in, of the one subcommand that is parsed; turned into CommonOptions when all is known.
struct RawOptions {
  base::GivenKnobs knobs, views;
  std::vector<std::string> environments; // each --env of what takes several
  std::string cache, cacheSize = "4G";
  std::string pixelData; // empty: not given
  std::string pictures = job::kPicturesNames.front();
  bool noCache = false, quiet = false, validation = false;
};

// Options of the knobs of these groups ("Scene", "Picture", ...) that are in `common`; `view`: those of a view, too.
// common.settings holds what is where nothing is given. without: ids that the subcommand does not read.
void addKnobs(CLI::App& app, CommonOptions& common, RawOptions& raw, const std::vector<std::string>& groups,
              const std::vector<std::string>& without = {});
void addViewKnobs(CLI::App& app, RawOptions& raw);
// --env, as often as one likes: each scene is compared in each.
void addEnvironments(CLI::App& app, RawOptions& raw);
// --csv of what compares.
void addCsvOption(CLI::App& app, std::string& csv);
// Throws CLI::ValidationError where JSON and CSV are both to go to stdout.
void requireOneOnStdout(const std::string& json, const std::string& csv);

// Device, threads, cache, verbosity.
void addRunOptions(CLI::App& app, CommonOptions& common, RawOptions& raw);
// --only.
void addOnlyOption(CLI::App& app, std::vector<std::string>& only);
// Scenes, or --suite, and --only of either.
void addSceneList(CLI::App& app, std::vector<std::string>& scenes, std::string& suite, std::vector<std::string>& only);
void addBudgetsOption(CLI::App& app, CommonOptions& common);
// What a report's page holds: --single-file, --pixel-data, --pictures.
void addPageOptions(CLI::App& app, ReportCommand& report, RawOptions& raw);
void settlePage(ReportCommand& report, const RawOptions& raw);
void addSentinelOption(CLI::App& app, ReportCommand& report);
void addBenchOption(CLI::App& app, std::string& bench);

// Checks what CLI11 has filled in, and turns it into settings: beside a suite, whose scenes say more, each value alone.
// Throws CLI::ValidationError.
void settle(const CLI::App& app, CommonOptions& common, const RawOptions& raw, bool isBesideSuite = false);
// Beside a suite: a suite says for itself how each scene is lit and seen. Throws CLI::ExcludesError.
void requireNoneOfScene(const RawOptions& raw);

// What a view takes for each pixel of --size at its peak, measured (docs/limits.md): compared by two paths, and drawn
// by one.
inline constexpr std::size_t kComparedPixelBytes = 350, kDrawnPixelBytes = 64;
// After settle(). Throws CLI::ValidationError where that is more than --max-memory.
void requireSizeFits(const CommonOptions& common, std::size_t pixelBytes);

} // namespace parity::cli
