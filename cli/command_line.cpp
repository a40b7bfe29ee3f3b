// The subcommands and their options, by CLI11.
#include <CLI/CLI.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "cli/again.h"
#include "cli/invocation.h"
#include "cli/options/approve_options.h"
#include "cli/options/bake_options.h"
#include "cli/options/bench_options.h"
#include "cli/options/budget_options.h"
#include "cli/options/cache_options.h"
#include "cli/options/command_help.h"
#include "cli/options/common_options.h"
#include "cli/options/contract_options.h"
#include "cli/options/explain_options.h"
#include "cli/options/export_options.h"
#include "cli/options/fit_options.h"
#include "cli/options/flip_options.h"
#include "cli/options/guide_options.h"
#include "cli/options/history_options.h"
#include "cli/options/mistyped.h"
#include "cli/options/option_parts.h"
#include "cli/options/plan_options.h"
#include "cli/options/plot_options.h"
#include "cli/options/preset_options.h"
#include "cli/options/render_options.h"
#include "cli/options/stress_options.h"
#include "cli/options/suite_options.h"

namespace parity::cli {

namespace {

// An empty value is a variable of a script that is not set: nothing that can be meant.
void requireValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (std::ranges::any_of(option->results(), [](const std::string& value) { return value.empty(); }))
      throw CLI::ValidationError(option->get_name(), "has an empty value");
  for (const CLI::App* chosen : app.get_subcommands()) requireValues(*chosen);
}

// -v: of every subcommand that runs something.
void addVerbose(CLI::App& app, bool& verbose) {
  const std::vector<CLI::App*> below = app.get_subcommands([](const CLI::App*) { return true; });
  if (below.empty())
    app.add_flag("-v,--verbose", verbose, "Print to stderr what is done, and with what")->group(kGeneralGroup);
  for (CLI::App* each : below) addVerbose(*each, verbose);
}

// Groups of knobs of what compares.
const std::vector<std::string> kCompared = {"Scene", "Picture", "Paths", "Truth", "Verdict"};
// What `info` and `export` do not read of a scene.
const std::vector<std::string> kNotRead = {"env",
                                           "env-rotation",
                                           "sun-extraction",
                                           "sun",
                                           "sky-light-color",
                                           "indirect-color-scale",
                                           "sun-specular-scale",
                                           "falloff",
                                           "fog",
                                           "fog-color",
                                           "fog-start",
                                           "fog-opacity",
                                           "fully-rough",
                                           "baked",
                                           "subject"};

// git bisect takes 64 for "bad": a mistyped option would name a commit that is not to blame.
constexpr int kStopsBisect = 128;
bool isForBisect(const CLI::App& app) { return fullName(app) == "parity history step"; }

// What a command line that was refused is told: what CLI11 says, unless a name is not known at all.
Parsed refuse(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = describeMistyped(app);
  if (text.empty()) text = error.what();
  return {.command = {},
          .text = fmt::format("{}\nRun '{} --help' for more information.\n", text, fullName(chosenOf(app))),
          .exitCode = isForBisect(chosenOf(app)) ? kStopsBisect : static_cast<int>(base::ExitCode::usage)};
}

} // namespace

// NOLINTNEXTLINE(readability-function-size): a list, read from top to bottom
Parsed parseCommandLine(int argc, const char* const* argv) {
  CLI::App app(introduction(), "parity");
  app.require_subcommand(1);
  bool version = false, listTerms = false; // asked for: they need nothing else
  app.add_flag_callback(
         "--version",
         [&version] {
           version = true;
           throw CLI::Success();
         },
         "Print version, build and Vulkan device")
      ->group(kGeneralGroup);

  RawOptions raw;
  ReportCommand report;
  DiffCommand diff;
  CLI::App& reportApp =
      *app.add_subcommand("report", "Compare scenes and write a report: index.html, report.json, junit.xml, images");
  addSceneList(reportApp, report.scenes, report.suite, report.common);
  report.folder = kDefaultReportFolder;
  reportApp.add_option("-o,--output", report.folder, "Folder for the report")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->capture_default_str();
  addPageOptions(reportApp, report, raw);
  addSentinelOption(reportApp, report);
  addBenchOption(reportApp, report.bench);
  RawOutcome rawOutcome;
  addVerdictOptions(reportApp, report.verdict, rawOutcome,
                    "Show all rows of the table. Default: those that failed, warned or could not be judged");
  RawWorkers rawWorkers;
  addWorkerOptions(reportApp, report.workers, rawWorkers,
                   "Compare scenes in this many worker processes: a crash costs one scene. Default: in this process");
  for (const char* option : {"--timeout", "--memory"})
    reportApp.get_option(option)->needs(reportApp.get_option("--jobs"));
  reportApp.add_option("--json", report.common.json, "Also write report.json to this file; - for stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);
  addCsvOption(reportApp, report.csv);
  PlanCommand plan;
  for (job::Settings* settings : {&report.common.settings, &plan.report.common.settings, &diff.common.settings}) {
    settings->attribution = job::Attribution::overBudget;
    settings->droppedLights = 8;
  }
  addKnobs(reportApp, report.common, raw, kCompared, {"env"});
  addEnvironments(reportApp, raw);
  addViewKnobs(reportApp, raw);
  addRunOptions(reportApp, report.common, raw);
  addBudgetsOption(reportApp, report.common);

  CLI::App& planApp =
      *app.add_subcommand("plan", "Freeze a report over many machines: its scenes, settings and shards");
  addSceneList(planApp, plan.report.scenes, plan.report.suite, plan.report.common);
  addPlanOptions(planApp, plan);
  addPageOptions(planApp, plan.report, raw);
  addSentinelOption(planApp, plan.report);
  addKnobs(planApp, plan.report.common, raw, kCompared, {"env"});
  addEnvironments(planApp, raw);
  addViewKnobs(planApp, raw);
  addRunOptions(planApp, plan.report.common, raw);
  addBudgetsOption(planApp, plan.report.common);

  RawWork rawWork;
  CLI::App& workApp = *app.add_subcommand("work", "Compare the scenes of a plan, or of one of its shards");
  addWorkOptions(workApp, rawWork);

  RawMerge rawMerge;
  CLI::App& mergeApp = *app.add_subcommand("merge", "Write the report of a plan from what its shards have done");
  addMergeOptions(mergeApp, rawMerge);

  CLI::App& diffApp = *app.add_subcommand(
      "diff", "Compare one scene, or those of a suite, and print a table with one row for each material");
  diffApp.add_option("scene", diff.scene, "Scene file or builtin:NAME")->type_name(kSceneFile);
  diffApp.add_option("--suite", diff.suite, "Suite file (TOML) in place of a scene; --only chooses its views")
      ->type_name(kFile)
      ->group(kInputGroup)
      ->excludes("scene");
  addVerdictOptions(diffApp, diff.verdict, rawOutcome,
                    "Show all rows. Default: all of up to 24, else those that failed, warned or could not be judged");
  addOnlyOption(diffApp, diff.common.only);
  diffApp
      .add_option("--json", diff.common.json,
                  "Write the result as JSON to this file; - for stdout, instead of the table")
      ->type_name(kFile)
      ->group(kOutputGroup);
  addCsvOption(diffApp, diff.csv);
  addKnobs(diffApp, diff.common, raw, kCompared, {"env"});
  addEnvironments(diffApp, raw);
  addViewKnobs(diffApp, raw);
  addRunOptions(diffApp, diff.common, raw);
  addBudgetsOption(diffApp, diff.common);

  RenderCommand render;
  CLI::App& renderApp = *app.add_subcommand("render", "Render one scene with one path");
  addRenderOptions(renderApp, render, listTerms);
  addKnobs(renderApp, render.common, raw, {"Scene", "Picture", "Paths", "Truth"}, {"truth", "costs", "paths"});
  addViewKnobs(renderApp, raw);
  addRunOptions(renderApp, render.common, raw);

  ContractCommand contract;
  CLI::App& contractApp =
      *app.add_subcommand("contract", "Write what another engine needs to render the views of scenes, as a folder");
  addContractOptions(contractApp, contract, raw);

  CalibrateCommand calibrate;
  CLI::App& calibrateApp =
      *app.add_subcommand("calibrate", "Say what an engine's picture of the calibration scene tells of the engine");
  addCalibrateOptions(calibrateApp, calibrate);

  FlipCommand flip;
  RawFlipOptions rawFlip;
  CLI::App& flipApp = *app.add_subcommand("flip", "Compare any two images, two folders of images, or a list of pairs");
  addFlipOptions(flipApp, flip, rawFlip);

  RawApprove rawApprove;
  CLI::App& approveApp =
      *app.add_subcommand("approve", "Accept figures of a report that are over budget, until a day, for a reason");
  addApproveOptions(approveApp, rawApprove);

  RawBudgetOptions budget;
  CLI::App& budgetApp = *app.add_subcommand("budget", "Propose a budget file from earlier reports, or check one");
  addBudgetOptions(budgetApp, budget);

  RawFitOptions rawFit;
  CLI::App& fitApp =
      *app.add_subcommand("fit", "Fit the preset refit to the settings of a path, and print its constants");
  addFitOptions(fitApp, rawFit);

  RawPlotOptions rawPlot;
  CLI::App& plotApp =
      *app.add_subcommand("plot", "Draw a formula of two paths and their difference, also on the materials of a scene");
  addPlotOptions(plotApp, rawPlot);

  RawBenchOptions rawBench;
  CLI::App& benchApp = *app.add_subcommand(
      "bench", "Measure error and run time of every setting on the same surfaces, with Pareto plots");
  addBenchOptions(benchApp, rawBench);

  RawExplainOptions rawExplain;
  CLI::App& explainApp = *app.add_subcommand(
      "explain", "Find what would help each material: the best sets of changes, and what they cost");
  addExplainOptions(explainApp, rawExplain);

  CLI::App& worstApp = *app.add_subcommand(
      "worst", "Find the view, the sun and the rotation of the environment that show a scene at its worst");
  addWorstOptions(worstApp, rawExplain);

  RawPresetOptions rawPreset;
  CLI::App& presetApp = *app.add_subcommand("preset", "Start a preset folder of your own formulas");
  addPresetOptions(presetApp, rawPreset);
  CLI::App& studyApp =
      *app.add_subcommand("study-preset", "Measure presets: error, stress and cost of their formulas, in one page");
  addStudyPresetOptions(studyApp, rawPreset);

  RawStressOptions rawStress;
  CLI::App& stressApp = *app.add_subcommand(
      "stress", "Test every shading function and whole renders at the edges of their domains; 2: a new finding");
  addStressOptions(stressApp, rawStress);

  BakeCommand bake;
  RawBakeOptions rawBake;
  CLI::App& bakeApp = *app.add_subcommand(
      "bake", "Bake the light of static scenes: lightmaps for both paths, the sun's shadow, environment captures");
  addBakeOptions(bakeApp, bake, rawBake);
  addOnlyOption(bakeApp, bake.common.only);
  addKnobs(bakeApp, bake.common, raw, {"Scene"}, {"fully-rough", "baked"});
  addRunOptions(bakeApp, bake.common, raw);

  DevicesCommand devices;
  CLI::App& devicesApp = *app.add_subcommand("devices", "List Vulkan devices, and the reason why each is used or not");
  devicesApp.add_option("--device", devices.device.name, "Show which device this option selects")
      ->type_name("DEVICE")
      ->group(kMachineGroup);
  devicesApp.add_option("--json", devices.json, "Write the list as JSON to this file; - for stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);

  InfoCommand info;
  CLI::App& infoApp = *app.add_subcommand("info", "Show the content of a scene's file, and its errors");
  infoApp.add_option("file", info.scene, "Scene file or builtin:NAME")->required()->type_name(kSceneFile);
  infoApp
      .add_option("--json", info.common.json,
                  "Write the content as JSON to this file; - for stdout, instead of the text")
      ->type_name(kFile)
      ->group(kOutputGroup);
  addKnobs(infoApp, info.common, raw, {"Scene"}, kNotRead);

  ExportCommand exported;
  CLI::App& exportApp =
      *app.add_subcommand("export", "Write a scene, also a built-in one, as one binary glTF file (.glb)");
  addExportOptions(exportApp, exported);
  addKnobs(exportApp, exported.common, raw, {"Scene"}, kNotRead);

  const CLI::App& knobsApp = *app.add_subcommand(
      "knobs", "Print every setting: its option, its key in a suite file, its values and its default");

  RawCacheOptions rawCache;
  CLI::App& cacheApp = *app.add_subcommand("cache", "Show or remove what is kept between runs");
  addCacheOptions(cacheApp, rawCache);

  RawSuiteOptions rawSuite;
  CLI::App& suiteApp = *app.add_subcommand("suite", "Show what a suite file means");
  addSuiteOptions(suiteApp, rawSuite);

  RawHistoryOptions rawHistory;
  CLI::App& historyApp =
      *app.add_subcommand("history", "Keep the figures of each night: what changed, when, since which commit, and why");
  addHistoryOptions(historyApp, rawHistory);

  bool verbose = false;
  addVerbose(app, verbose);

  RawGuideOptions rawGuide;
  addGuideOptions(app, rawGuide);
  addHelp(app);

  std::vector<std::string> arguments = expandHelp({argv + 1, argv + argc});
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
  Parsed parsed;
  try {
    app.parse(arguments);
    if (verbose) base::setLogLevel(base::LogLevel::verbose); // -q, which is asked later, goes first
    requireValues(app);
    if (reportApp.parsed()) {
      if (report.scenes.empty() && report.suite.empty()) throw CLI::RequiredError("report: SCENE or --suite");
      if (!report.suite.empty()) requireNoneOfScene(raw);
      settle(reportApp, report.common, raw, !report.suite.empty());
      requireSizeFits(report.common, kComparedPixelBytes);
      requireOneOnStdout(report.common.json, report.csv);
      settleWorkers(report.workers, rawWorkers);
      settlePage(report, raw);
      settleOutcome(report.verdict, rawOutcome);
      requireBaseline(report.verdict);
      report.kept = keptWords(reportApp, diffApp);
      parsed.command = report;
    } else if (planApp.parsed()) {
      ReportCommand& planned = plan.report;
      if (planned.scenes.empty() && planned.suite.empty()) throw CLI::RequiredError("plan: SCENE or --suite");
      if (!planned.suite.empty()) requireNoneOfScene(raw);
      settle(planApp, planned.common, raw, !planned.suite.empty());
      requireSizeFits(planned.common, kComparedPixelBytes);
      settlePage(planned, raw);
      planned.kept = keptWords(planApp, diffApp);
      parsed.command = plan;
    } else if (workApp.parsed()) {
      parsed.command = settleWork(rawWork);
    } else if (mergeApp.parsed()) {
      parsed.command = settleMerge(rawMerge);
    } else if (diffApp.parsed()) {
      if (diff.scene.empty() && diff.suite.empty()) throw CLI::RequiredError("diff: SCENE or --suite");
      if (!diff.suite.empty()) requireNoneOfScene(raw);
      settle(diffApp, diff.common, raw, !diff.suite.empty());
      requireSizeFits(diff.common, kComparedPixelBytes);
      requireOneOnStdout(diff.common.json, diff.csv);
      settleOutcome(diff.verdict, rawOutcome);
      requireBaseline(diff.verdict);
      parsed.command = diff;
    } else if (renderApp.parsed()) {
      settle(renderApp, render.common, raw);
      requireSizeFits(render.common, kDrawnPixelBytes);
      if (render.path == "reference") {
        base::logInfo("--path reference is now called --path truth");
        render.path = "truth";
      }
      parsed.command = render;
    } else if (contractApp.parsed()) {
      if (contract.scenes.empty() && contract.suite.empty()) throw CLI::RequiredError("contract: SCENE or --suite");
      if (!contract.suite.empty()) requireNoneOfScene(raw);
      settle(contractApp, contract.common, raw, !contract.suite.empty());
      requireSizeFits(contract.common, kDrawnPixelBytes);
      parsed.command = contract;
    } else if (calibrateApp.parsed()) {
      parsed.command = calibrate;
    } else if (flipApp.parsed()) {
      settleFlip(flipApp, flip, rawFlip);
      parsed.command = flip;
    } else if (approveApp.parsed()) {
      parsed.command = settleApprove(rawApprove);
    } else if (budgetApp.parsed()) {
      parsed.command = settleBudget(budgetApp, budget);
    } else if (fitApp.parsed()) {
      parsed.command = settleFit(rawFit);
    } else if (plotApp.parsed()) {
      parsed.command = settlePlot(rawPlot);
    } else if (worstApp.parsed()) {
      parsed.command = settleWorst(worstApp, rawExplain);
    } else if (explainApp.parsed()) {
      parsed.command = settleExplain(explainApp, rawExplain);
    } else if (benchApp.parsed()) {
      parsed.command = settleBench(benchApp, rawBench);
    } else if (presetApp.parsed()) {
      parsed.command = settlePreset(presetApp, rawPreset);
    } else if (studyApp.parsed()) {
      parsed.command = settleStudyPreset(studyApp, rawPreset);
    } else if (stressApp.parsed()) {
      parsed.command = settleStress(rawStress);
    } else if (bakeApp.parsed()) {
      if (!bake.suite.empty()) requireNoneOfScene(raw);
      settle(bakeApp, bake.common, raw, !bake.suite.empty());
      parsed.command = settleBake(bake, rawBake, bakeApp);
    } else if (infoApp.parsed()) {
      settle(infoApp, info.common, raw);
      parsed.command = info;
    } else if (exportApp.parsed()) {
      settle(exportApp, exported.common, raw);
      parsed.command = exported;
    } else if (knobsApp.parsed()) {
      parsed.command = KnobsCommand();
    } else if (cacheApp.parsed()) {
      parsed.command = settleCache(cacheApp, rawCache);
    } else if (suiteApp.parsed()) {
      parsed.command = settleSuite(rawSuite);
    } else if (historyApp.parsed()) {
      parsed.command = settleHistory(historyApp, rawHistory);
    } else if (devicesApp.parsed()) {
      parsed.command = devices;
    } else {
      parsed.command = settleGuide(app, rawGuide);
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return refuse(app, error);
    if (version)
      parsed.command = VersionCommand();
    else if (listTerms)
      parsed.command = ListTermsCommand();
    else if (!describeMistyped(app).empty())
      return refuse(app, error); // help of what is no command
    else
      parsed.text = app.help();
  }
  return parsed;
}

} // namespace parity::cli
