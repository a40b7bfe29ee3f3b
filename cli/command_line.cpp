// The subcommands and their options, by CLI11.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "base/log.h"
#include "base/text/nearest.h"
#include "base/version.h"
#include "cli/invocation.h"
#include "cli/options/bake_options.h"
#include "cli/options/bench_options.h"
#include "cli/options/budget_options.h"
#include "cli/options/cache_options.h"
#include "cli/options/common_options.h"
#include "cli/options/fit_options.h"
#include "cli/options/flip_options.h"
#include "cli/options/option_parts.h"
#include "cli/options/plot_options.h"
#include "cli/options/stress_options.h"
#include "cli/output.h"

namespace parity::cli {

namespace {

// CLI11 would only say that a subcommand is required.
void requireKnownSubcommand(const CLI::App& app, int argc, const char* const* argv) {
  const auto known = app.get_subcommands([](const CLI::App*) { return true; });
  if (argc > 1 && argv[1][0] != '-' &&
      std::none_of(known.begin(), known.end(), [&](const CLI::App* s) { return s->check_name(argv[1]); }))
    throw CLI::ValidationError(argv[1], "unknown subcommand; 'parity --help' lists them");
}

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
  if (below.empty()) app.add_flag("-v,--verbose", verbose, "Print to stderr what is done, and with what");
  for (CLI::App* each : below) addVerbose(*each, verbose);
}

// Groups of knobs of what compares.
const std::vector<std::string> kCompared = {"Scene", "Picture", "Paths", "Truth", "Verdict"};
// What `info` does not show of a scene.
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

constexpr const char* kIntro = R"(parity: does a material look the same on two shading paths?

Renders a glTF scene by a high-end path (full GGX, tabulated environment BRDF, all lights) and by a mobile path (Karis 2014, UE4's
base pass), compares them per material by FLIP, and judges them against budgets.

  parity report scene.glb --env studio.hdr --sun 30,50,4 -o out      report with pictures: out/index.html
  parity diff   scene.glb --env studio.hdr                           table with one row for each material
  parity flip   reference.png test.png -o map.exr                    compare any two images
  parity budget suggest out/report.json -o budgets.toml              suggest limits from observed figures
  parity fit --geometry-term schlick-smith --format hlsl             fit the preset refit to your own path
  parity plot env-brdf scene.glb -o plot                             error of EnvBRDFApprox against the table
  parity bench scene.glb --env studio.hdr --budget flip.mean=0.02 -o out   time and error of each setting
  parity bake scene.glb --env studio.hdr -o baked                    bake all light except the sun's, for --baked baked
  parity stress -o stress                                            find results that are not finite, negative or wrong
)";

constexpr const char* kFooter = R"(
Exit codes: 0 within budget; 1 warnings only (with --warn-exit); 2 over budget (stress: a new finding; bench: a setting is slower,
or none is within the budget); 3 not comparable (sizes, channels, layers, or a metric that does not apply); 4 a file is missing or
not finite, a step failed (read, render, judge, write), or no material was compared; 64 wrong usage. The highest code wins. If a
scene fails, the others still run. Scenes are .gltf or .glb files, or builtin:materials, builtin:spheres, builtin:lights,
builtin:lamps, builtin:shadows, builtin:room, builtin:courtyard, builtin:furnace.)";

} // namespace

// NOLINTNEXTLINE(readability-function-size): a list, read from top to bottom
Parsed parseCommandLine(int argc, const char* const* argv) {
  CLI::App app(kIntro, "parity");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("parity ") + base::kVersion);
  app.get_formatter()->column_width(34);

  RawOptions raw;
  ReportCommand report;
  DiffCommand diff;
  CLI::App& reportApp =
      *app.add_subcommand("report", "Compare scenes and write a report: index.html, report.json, junit.xml, images");
  reportApp.add_option("scenes", report.scenes, "Scene files or builtin:NAME");
  CLI::Option* suite = reportApp.add_option("--suite", report.suite,
                                            "Suite file (TOML): many scenes, with their views, light and budgets");
  suite->excludes(reportApp.get_option("scenes"));
  reportApp.add_option("-o,--output", report.folder, "Folder for the report")->required();
  addPageOptions(reportApp, report, raw);
  addVerdictOptions(reportApp, report.verdict);
  reportApp.add_option("--json", report.common.json, "Also write report.json to this file; - for stdout");
  for (job::Settings* settings : {&report.common.settings, &diff.common.settings}) {
    settings->attribution = job::Attribution::overBudget;
    settings->droppedLights = 8;
  }
  addKnobs(reportApp, report.common, raw, kCompared);
  addViewKnobs(reportApp, raw);
  addRunOptions(reportApp, report.common, raw);
  addBudgetsOption(reportApp, report.common);

  CLI::App& diffApp = *app.add_subcommand("diff", "Compare one scene and print a table with one row for each material");
  diffApp.add_option("scene", diff.scene, "Scene file or builtin:NAME")->required();
  addVerdictOptions(diffApp, diff.verdict);
  diffApp.add_option("--json", diff.common.json,
                     "Write the result as JSON to this file; - for stdout, instead of the table");
  addKnobs(diffApp, diff.common, raw, kCompared);
  addViewKnobs(diffApp, raw);
  addRunOptions(diffApp, diff.common, raw);
  addBudgetsOption(diffApp, diff.common);

  RenderCommand render;
  CLI::App& renderApp = *app.add_subcommand("render", "Render one scene with one path");
  renderApp.add_option("scene", render.scene, "Scene file or builtin:NAME")->required();
  std::vector<std::string> renderedPaths = job::pathNames();
  renderedPaths.insert(renderedPaths.end(), {"truth", "reference"}); // the older name of it
  renderApp
      .add_option(
          "--path", render.path,
          fmt::format("Path: {} or truth (ground truth: exact integrals, slow)", fmt::join(job::pathNames(), ", ")))
      ->required()
      ->check(CLI::IsMember(renderedPaths));
  renderApp
      .add_option("-o,--output", render.output,
                  "Picture to write. .exr, .pfm, .hdr: linear scene-referred values; .png: as displayed")
      ->required()
      ->check(fileOfKind({".exr", ".pfm", ".hdr", ".png"}));
  renderApp.add_flag("--terms", render.common.settings.terms,
                     "Also write the terms of light, as layers of the .exr file");
  renderApp
      .add_option("--term", render.term,
                  "Write one term, or one intermediate of the path's shader, instead of the colour (--list-terms)")
      ->check(CLI::Validator(
          [](const std::string& name) {
            const std::vector<std::string> names = termNames();
            const std::vector<std::string_view> known(names.begin(), names.end());
            return std::find(known.begin(), known.end(), name) != known.end()
                       ? std::string()
                       : name + ": unknown term; " + base::describeNearest(name, known);
          },
          "NAME"));
  bool listTerms = false;
  renderApp.add_flag_callback(
      "--list-terms",
      [&listTerms] {
        listTerms = true;
        throw CLI::Success(); // needs no scene
      },
      "List the values of --term");
  renderApp.add_option("--error-map", render.errorMap, "Write the relative standard error of each pixel to this file")
      ->check(fileOfKind({".exr", ".pfm"}))
      ->group("Truth");
  addKnobs(renderApp, render.common, raw, {"Scene", "Picture", "Paths", "Truth"}, {"truth", "costs", "paths"});
  addViewKnobs(renderApp, raw);
  addRunOptions(renderApp, render.common, raw);

  FlipCommand flip;
  RawFlipOptions rawFlip;
  CLI::App& flipApp = *app.add_subcommand("flip", "Compare any two images, two folders of images, or a list of pairs");
  addFlipOptions(flipApp, flip, rawFlip);

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

  RawStressOptions rawStress;
  CLI::App& stressApp = *app.add_subcommand(
      "stress", "Test every shading function and whole renders at the edges of their domains; 2: a new finding");
  addStressOptions(stressApp, rawStress);

  BakeCommand bake;
  RawBakeOptions rawBake;
  CLI::App& bakeApp = *app.add_subcommand(
      "bake", "Bake the light of static scenes: lightmaps for both paths, the sun's shadow, environment captures");
  addBakeOptions(bakeApp, bake, rawBake);
  addKnobs(bakeApp, bake.common, raw, {"Scene"}, {"fully-rough", "baked"});
  addRunOptions(bakeApp, bake.common, raw);

  DevicesCommand devices;
  CLI::App& devicesApp = *app.add_subcommand("devices", "List Vulkan devices, and the reason why each is used or not");
  devicesApp.add_option("--device", devices.device.name, "Show which device this option selects");
  devicesApp.add_option("--json", devices.json, "Write the list as JSON to this file; - for stdout");

  InfoCommand info;
  CLI::App& infoApp = *app.add_subcommand("info", "Show the content of a scene's file, and its errors");
  infoApp.add_option("file", info.scene, "Scene file or builtin:NAME")->required();
  infoApp.add_option("--json", info.common.json,
                     "Write the content as JSON to this file; - for stdout, instead of the text");
  addKnobs(infoApp, info.common, raw, {"Scene"}, kNotRead);

  const CLI::App& knobsApp = *app.add_subcommand(
      "knobs", "Print every setting: its option, its key in a suite file, its values and its default");

  RawCacheOptions rawCache;
  CLI::App& cacheApp = *app.add_subcommand("cache", "Show or remove what is kept between runs");
  addCacheOptions(cacheApp, rawCache);

  bool verbose = false;
  addVerbose(app, verbose);

  Parsed parsed;
  try {
    requireKnownSubcommand(app, argc, argv);
    app.parse(argc, argv);
    if (verbose) base::setLogLevel(base::LogLevel::verbose); // -q, which is asked later, goes first
    requireValues(app);
    if (reportApp.parsed()) {
      if (report.scenes.empty() && report.suite.empty()) throw CLI::RequiredError("report: SCENE or --suite");
      if (!report.suite.empty()) requireNoneOfScene(raw);
      settle(reportApp, report.common, raw, !report.suite.empty());
      requireSizeFits(report.common, kComparedPixelBytes);
      report.pixelData = raw.pixelData.empty() ? !report.singleFile : raw.pixelData == "all";
      parsed.command = report;
    } else if (diffApp.parsed()) {
      settle(diffApp, diff.common, raw);
      requireSizeFits(diff.common, kComparedPixelBytes);
      parsed.command = diff;
    } else if (renderApp.parsed()) {
      settle(renderApp, render.common, raw);
      requireSizeFits(render.common, kDrawnPixelBytes);
      if (render.path == "reference") {
        base::logInfo("--path reference is now called --path truth");
        render.path = "truth";
      }
      parsed.command = render;
    } else if (flipApp.parsed()) {
      settleFlip(flipApp, flip, rawFlip);
      parsed.command = flip;
    } else if (budgetApp.parsed()) {
      parsed.command = settleBudget(budgetApp, budget);
    } else if (fitApp.parsed()) {
      parsed.command = settleFit(rawFit);
    } else if (plotApp.parsed()) {
      parsed.command = settlePlot(rawPlot);
    } else if (benchApp.parsed()) {
      parsed.command = settleBench(benchApp, rawBench);
    } else if (stressApp.parsed()) {
      parsed.command = settleStress(rawStress);
    } else if (bakeApp.parsed()) {
      if (!bake.suite.empty()) requireNoneOfScene(raw);
      settle(bakeApp, bake.common, raw, !bake.suite.empty());
      parsed.command = settleBake(bake, rawBake, bakeApp);
    } else if (infoApp.parsed()) {
      settle(infoApp, info.common, raw);
      parsed.command = info;
    } else if (knobsApp.parsed()) {
      parsed.command = KnobsCommand();
    } else if (cacheApp.parsed()) {
      parsed.command = settleCache(cacheApp, rawCache);
    } else {
      parsed.command = devices;
    }
  } catch (const CLI::ParseError& error) {
    if (listTerms) {
      parsed.command = ListTermsCommand();
      return parsed;
    }
    std::ostringstream out, err;
    const bool asked = app.exit(error, out, err) == 0; // --help, --version
    parsed.text = asked ? out.str() : err.str();
    parsed.exitCode = asked ? 0 : static_cast<int>(base::ExitCode::usage);
  }
  return parsed;
}

} // namespace parity::cli
