// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/worst_options.h"

#include "cli/options/option_parts.h"

namespace parity::cli {

void addWorstOptions(CLI::App& app, RawWorstOptions& raw) {
  WorstCommand& worst = raw.worst;
  worst.common.settings.width = worst.common.settings.height = 512;
  app.add_option("scene", worst.scene, "Scene file or builtin:NAME")->type_name(kSceneFile)->required();
  app.add_option("--points", worst.options.search.points,
                 "Pictures that are spread over the views, before the best are refined")
      ->check(wholeWithin(8, 100000))
      ->group("Worst")
      ->capture_default_str();
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

WorstCommand settleWorst(const CLI::App& app, const RawWorstOptions& raw) {
  WorstCommand command = raw.worst;
  settle(app, command.common, raw.common);
  requireSizeFits(command.common, kComparedPixelBytes);
  return command;
}

} // namespace parity::cli
