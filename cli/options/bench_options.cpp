// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/bench_options.h"

#include "base/error.h"
#include "base/log.h"
#include "cli/options/option_parts.h"
#include "job/knobs.h"

namespace parity::cli {

void addBenchOptions(CLI::App& app, RawBenchOptions& raw) {
  BenchCommand& bench = raw.bench;
  job::Settings& s = bench.common.settings;
  s.width = s.height = 256;
  s.reference.integral.relativeError = 0.02;
  job::knobs().find("precision")->set(s, {"fp32"}); // a software device emulates half; every preset is tried in both
  addSceneList(app, bench.scenes, bench.suite, bench.common.only);
  app.add_option("-o,--output", bench.folder,
                 "Folder for index.html, bench.json, bench.csv, bench.md (one table of all scenes) and pictures")
      ->type_name(kFolder)
      ->group("Output");
  app.add_option("--json", bench.common.json, "Write bench.json to this file; - for stdout, instead of the table")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--csv", bench.csv, "Write bench.csv to this file; - for stdout, instead of the table")
      ->type_name(kFile)
      ->group("Output");
  app.add_option("--budget", raw.budget,
                 "NAME=LIMIT (flip.mean, flip.p95, relmse): name the fastest setting within it; exit 2 if none is")
      ->type_name("NAME=LIMIT")
      ->group("Bench");
  app.add_option("--compare", bench.compare,
                 "Earlier bench.json: show time ratios with confidence intervals; exit 2 if a setting is slower")
      ->type_name(kFile)
      ->group("Bench");
  repeat(app.add_option("--settings", bench.trial.settings,
                        "Only these settings and the defaults (repeatable): globs such as '*: refit*';\n"
                        "with --scaling such as 'lights'"))
      ->type_name("GLOB")
      ->group("Bench");
  app.add_flag("--list", bench.list, "List the settings")->group("Bench");
  app.add_option("--rounds", bench.trial.rounds, "Timed rounds, in random order. An untimed round compiles first")
      ->check(wholeWithin(2, 1000))
      ->group("Bench")
      ->capture_default_str();
  app.add_option("--preparation-rounds", bench.trial.preparationRounds,
                 "Timed rounds of what is prepared once, such as tables; --compare needs about 9 to judge")
      ->check(wholeWithin(2, 1000))
      ->group("Bench")
      ->capture_default_str();
  app.add_flag("--no-truth", raw.noTruth, "Do not measure errors against the truth; that takes most of the time")
      ->group("Bench");
  app.add_flag("--no-reference", raw.noReference, "Older name of --no-truth")->group("");
  app.add_flag("--scaling", bench.scaling,
               "Instead, time each stage over the number of pixels, triangles, lights, materials and textures,\n"
               "in generated scenes")
      ->group("Bench")
      ->excludes(app.get_option("scenes"))
      ->excludes(app.get_option("--suite"))
      ->excludes(app.get_option("--compare"))
      ->excludes(app.get_option("--budget"))
      ->excludes(app.get_option("--csv"));
  addKnobs(app, bench.common, raw.common, {"Scene", "Picture", "Paths", "Truth"},
           {"truth", "interreflection", "material", "costs"});
  addViewKnobs(app, raw.common);
  addRunOptions(app, bench.common, raw.common);
  app.remove_option(app.get_option("--timings"));
}

BenchCommand settleBench(const CLI::App& app, const RawBenchOptions& raw) {
  BenchCommand command = raw.bench;
  const bool isSuite = !command.suite.empty();
  if (command.scenes.empty() && !isSuite && !command.scaling && !command.list)
    throw CLI::RequiredError("bench: SCENE, --suite, --scaling or --list");
  if (isSuite) requireNoneOfScene(raw.common);
  settle(app, command.common, raw.common, isSuite);
  if (raw.noReference) base::logInfo("--no-reference is now called --no-truth");
  requireSizeFits(command.common, kComparedPixelBytes);
  command.common.settings.costs = command.common.plain.costs = true;
  command.trial.truth = !raw.noTruth && !raw.noReference;
  requireOneOnStdout(command.common.json, command.csv);
  if (!raw.budget.empty()) {
    try {
      command.budget = sweep::parseErrorBudget(raw.budget);
    } catch (const base::Error& error) {
      throw CLI::ValidationError("--budget", raw.budget + ": " + error.reason());
    }
  }
  return command;
}

} // namespace parity::cli
