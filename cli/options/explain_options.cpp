// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/explain_options.h"

#include "cli/options/option_parts.h"
#include "study/explain/switches.h"

namespace parity::cli {

void addExplainOptions(CLI::App& app, RawExplainOptions& raw) {
  ExplainCommand& explain = raw.explain;
  explain.common.settings.width = explain.common.settings.height = 256;
  addSceneList(app, explain.scenes, explain.suite, explain.common.only);
  repeat(app.add_option("--switch", explain.switches,
                        "A change to try, alone and with the others (repeatable, at most 7):\n"
                        "formulas=PRESET, or any of its settings. Default: those of a list that help most"))
      ->type_name("KNOB=VALUE")
      ->group("Explain");
  app.add_flag("--all", explain.allMaterials, "Also show materials that are within their limit")->group("Explain");
  app.add_option("--json", explain.common.json, "Write all figures to this file; - for stdout, instead of the table")
      ->type_name(kFile)
      ->group("Output");
  addKnobs(app, explain.common, raw.common, {"Scene", "Picture", "Paths"}, {"env", "costs"});
  addViewKnobs(app, raw.common);
  addEnvironments(app, raw.common);
  addBudgetsOption(app, explain.common);
  addRunOptions(app, explain.common, raw.common);
}

ExplainCommand settleExplain(const CLI::App& app, const RawExplainOptions& raw) {
  ExplainCommand command = raw.explain;
  const bool isSuite = !command.suite.empty();
  if (command.scenes.empty() && !isSuite) throw CLI::RequiredError("explain: SCENE or --suite");
  if (isSuite) requireNoneOfScene(raw.common);
  settle(app, command.common, raw.common, isSuite);
  requireSizeFits(command.common, kComparedPixelBytes);
  if (command.switches.size() > explain::kMaxSwitches)
    throw CLI::ValidationError("--switch", fmt::format("{} of them; at most {} are tried together",
                                                       command.switches.size(), explain::kMaxSwitches));
  return command;
}

void addWorstOptions(CLI::App& app, RawExplainOptions& raw) {
  WorstCommand& worst = raw.worst;
  worst.common.settings.width = worst.common.settings.height = 512;
  app.add_option("scene", worst.scene, "Scene file or builtin:NAME")->type_name(kSceneFile)->required();
  app.add_option("--points", worst.options.points,
                 "Pictures that are spread over the views, before the best are refined.\n"
                 "Default: 250 to 1600, fewer for scenes of more triangles")
      ->check(wholeWithin(8, 100000))
      ->group("Worst");
  app.add_option("--rotations", worst.options.rotations, "Rotations of the environment to try; 1: none")
      ->check(wholeWithin(1, 64))
      ->group("Worst")
      ->capture_default_str();
  app.add_option("--json", worst.common.json, "Write what was found to this file; - for stdout, instead of the text")
      ->type_name(kFile)
      ->group("Output");
  addKnobs(app, worst.common, raw.common, {"Scene", "Picture", "Paths"}, {"costs", "baked"});
  addViewKnobs(app, raw.common);
  addRunOptions(app, worst.common, raw.common);
}

WorstCommand settleWorst(const CLI::App& app, const RawExplainOptions& raw) {
  WorstCommand command = raw.worst;
  settle(app, command.common, raw.common);
  requireSizeFits(command.common, kComparedPixelBytes);
  return command;
}

} // namespace parity::cli
