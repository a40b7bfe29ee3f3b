// parity bench: what each setting costs and what it is worth.
#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/text/error_words.h"
#include "base/text/text.h"
#include "base/version.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "gpu/device/device_report.h"
#include "job/context.h"
#include "report/wording.h"
#include "study/sweep/machine.h"
#include "study/sweep/pareto_svg.h"
#include "study/sweep/scaling.h"
#include "study/sweep/statistics.h"
#include "study/sweep/summary.h"
#include "study/sweep/sweep_json.h"
#include "study/sweep/sweep_page.h"
#include "study/sweep/trial.h"

namespace parity::cli {

namespace {

int listSettings(const BenchCommand& command) {
  if (!command.suite.empty()) runRequest(command.common, {}, command.suite); // a wrong one is refused
  const std::vector<sweep::Variant> variants = sweep::makeVariants(command.common.settings);
  base::logDetail(fmt::format("{} settings", variants.size()));
  for (const sweep::Variant& v : variants) {
    if (!v.sameAs.empty()) {
      base::logDetail(fmt::format("{} is the same as {}", v.id(), v.sameAs));
      continue;
    }
    const std::string needs = v.needs.empty() ? "" : "   (needs: " + v.needs + ")";
    print("{}{}\n", v.id(), needs);
  }
  return 0;
}

int runScaling(const BenchCommand& command) {
  const auto series = sweep::measureScaling(
      command.common.settings, {.series = command.trial.settings, .rounds = std::min(command.trial.rounds, 5)},
      makeProgress(command.common.quiet));
  const std::string json = toJson(series, sweep::describeMachine(gpu::findDevice(command.common.settings.device)));
  if (!command.folder.empty()) base::writeText(std::filesystem::path(command.folder) / "scaling.json", json);
  if (!command.common.json.empty()) writeJson(command.common.json, json);
  if (command.common.json != "-" && !command.common.quiet) print("{}", toText(series));
  return 0;
}

std::string paretoName(std::size_t scene) { return fmt::format("pareto-{}.svg", scene + 1); }

// What was given to read must not be written over.
void requireSeparateFiles(const BenchCommand& command, const std::vector<job::SceneRequest>& requests) {
  std::vector<NamedFile> inputs = inputFiles(command.common, requests), outputs;
  inputs.push_back({"--compare", command.compare});
  inputs.push_back({"the suite", command.suite});
  if (!command.folder.empty())
    for (const char* file : {"index.html", "bench.json", "bench.csv", "bench.md"})
      outputs.push_back({"-o", std::filesystem::path(command.folder) / file});
  if (!command.folder.empty())
    for (std::size_t i = 0; i < requests.size(); ++i)
      outputs.push_back({"-o", std::filesystem::path(command.folder) / paretoName(i)});
  outputs.push_back({"--json", command.common.json});
  outputs.push_back({"--csv", command.csv});
  requireSeparate(outputs, inputs);
}

sweep::SweepReport measure(const BenchCommand& command, const RunRequest& run, const std::string& commandLine) {
  sweep::requireMatches(sweep::makeVariants(run.settings), command.trial.settings); // before the first scene is loaded
  job::Context context(run.settings);
  sweep::SweepReport report;
  report.version = base::kVersion;
  report.commandLine = commandLine;
  report.startedAt = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  report.machine = sweep::describeMachine(context.deviceReport());
  report.rounds = command.trial.rounds;
  const job::Progress progress = makeProgress(command.common.quiet);
  for (const job::SceneRequest& request : run.scenes) {
    try {
      const std::size_t index = report.scenes.size();
      report.scenes.push_back(
          sweep::runTrial(context, request, command.trial, progressOfScene(progress, index, run.scenes.size())));
    } catch (const std::exception& error) {
      // What was measured so far is not lost. A wrong command line is refused at the first scene; a suite's scenes have
      // options of their own, so that the others still run.
      const auto* known = dynamic_cast<const base::Error*>(&error);
      if (known && known->code() == base::ExitCode::usage && command.suite.empty() && report.scenes.empty()) throw;
      const std::string words = known ? known->what() : base::wordsOf(error);
      base::logError(request.name + ": " + words);
      sweep::SceneSweep& scene = report.scenes.emplace_back();
      scene.scene = request.name;
      scene.failure = words;
    }
  }
  return report;
}

// The settings that are worth their time, the fastest first.
void printScene(const sweep::SceneSweep& scene, const sweep::Conclusions& c) {
  if (!scene.failure.empty()) return;
  print("{} ({}, {} samples): settings on the Pareto front, by {} against the {}\n", base::plainLine(scene.scene),
        base::plainLine(scene.environment), scene.pixels, c.figure,
        c.against == sweep::Against::truth ? "truth" : report::titleOf(scene.variants.front().path) + " default");
  print("{:>10} {:>10} {:>10} {:>11}  setting\n", "device ms", c.figure, "operations", "compile ms");
  const std::vector<bool> dominated = sweep::findDominated(scene, c.against, c.figure);
  std::vector<const sweep::VariantResult*> front;
  for (std::size_t i = 0; i < dominated.size(); ++i)
    if (scene.variants[i].stage == sweep::Stage::shading && (!dominated[i] || scene.variants[i].name == "default"))
      front.push_back(&scene.variants[i]);
  std::ranges::sort(front, {}, [](const auto* v) { return std::pair(v->path, sweep::timeOf(*v)); });
  for (const sweep::VariantResult* v : front)
    print("{:>10.2f} {:>10.5f} {:>10.0f} {:>11.0f}  {}{}\n", sweep::timeOf(*v),
          sweep::errorOf(v->whole, c.against, c.figure).value_or(0), v->cost.operations, v->times.compileMs, v->id(),
          dominated[static_cast<std::size_t>(v - scene.variants.data())] ? " (dominated)" : "");
  print("\n");
}

void printConclusions(const sweep::Conclusions& c) {
  for (const auto& each : c.cheapest)
    print("fastest with {} <= {:g}, {}: {} {}\n", c.budget->figure, c.budget->limit,
          each.scene.empty() ? "all scenes" : base::plainLine(each.scene), each.path, each.setting.value_or("none"));
  for (const std::string& note : c.notes) print("note: {}\n", base::plainLine(note));
  for (const std::string& id : c.dominated) print("dominated in every scene: {}\n", id);
  if (!c.ratios) return;
  for (const std::string& note : c.ratios->notes) print("note: {}\n", base::plainLine(note));
  for (const sweep::VariantRatio& v : c.ratios->variants)
    if (v.time.isSlower() || v.time.isFaster())
      print("{}: {} {} (time x {:.3f}, confidence interval {:.3f} to {:.3f})\n",
            v.time.isSlower() ? "slower" : "faster", base::plainLine(v.scene), v.id, v.time.ratio, v.time.low,
            v.time.high);
  if (c.ratios->variants.empty())
    print("no setting could be judged against the earlier sweep\n");
  else if (std::ranges::none_of(c.ratios->variants,
                                [](const auto& v) { return v.time.isSlower() || v.time.isFaster(); }))
    print("none of the {} settings is slower or faster than before\n", c.ratios->variants.size());
}

int exitCodeOf(const sweep::SweepReport& report, const sweep::Conclusions& c) {
  const bool failed = std::ranges::any_of(report.scenes, [](const auto& scene) { return !scene.failure.empty(); }) ||
                      (c.ratios && c.ratios->variants.empty()); // what judged nothing is no pass
  const bool over = (c.ratios && c.ratios->anySlower()) ||
                    std::ranges::any_of(c.cheapest, [](const auto& each) { return !each.setting; });
  return static_cast<int>(failed ? base::ExitCode::failed
                          : over ? base::ExitCode::overBudget
                                 : base::ExitCode::withinBudget);
}

} // namespace

int runBenchCommand(const BenchCommand& command, const std::string& commandLine) {
  if (command.list) return listSettings(command);
  const base::ThreadLimit threads(command.common.threads);
  if (command.scaling) return runScaling(command);
  const RunRequest run = viewRequests(command.common, withListed(command.scenes, "scene"), command.suite);
  requireSeparateFiles(command, run.scenes);
  std::optional<sweep::SweepReport> earlier;
  if (!command.compare.empty()) earlier = sweep::readSweep(command.compare); // before the minutes that follow
  const sweep::SweepReport report = measure(command, run, commandLine);
  sweep::Conclusions conclusions = sweep::conclude(report, command.budget);
  const auto write = [&] {
    const std::string json = sweep::toJson(report, conclusions), csv = sweep::toCsv(report);
    if (!command.folder.empty()) {
      const std::filesystem::path folder = command.folder;
      base::writeText(folder / "bench.json", json);
      base::writeText(folder / "bench.csv", csv);
      base::writeText(folder / "bench.md", sweep::toMarkdown(report));
      writePage(folder, sweep::toPage(report, conclusions));
      for (std::size_t i = 0; i < report.scenes.size(); ++i) {
        const std::string svg =
            sweep::toSvg(plotOf(report.scenes[i], sweep::Stage::shading, conclusions.against, conclusions.figure));
        if (!svg.empty()) base::writeText(folder / paretoName(i), svg);
      }
      for (std::size_t i = report.scenes.size(); std::filesystem::remove(folder / paretoName(i)); ++i) {
      } // an earlier sweep's
    }
    if (!command.common.json.empty()) writeJson(command.common.json, json);
    if (command.csv == "-") printText(csv);
    if (!command.csv.empty() && command.csv != "-") base::writeText(command.csv, csv);
  };
  try {
    const auto isMeasured = [](const sweep::SceneSweep& scene) { return scene.failure.empty(); };
    if (earlier && std::ranges::any_of(report.scenes, isMeasured))
      conclusions.ratios = sweep::compareSweeps(*earlier, report);
  } catch (const base::Error&) {
    write(); // what was measured is not lost
    throw;
  }
  write();
  if (command.common.json != "-" && command.csv != "-" && !command.common.quiet) {
    for (const sweep::SceneSweep& scene : report.scenes) printScene(scene, conclusions);
    printConclusions(conclusions);
    if (!command.folder.empty()) printPage(command.folder, "bench.json");
  }
  return exitCodeOf(report, conclusions);
}

} // namespace parity::cli
