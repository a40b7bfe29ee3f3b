// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/plot_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/knob_options.h"
#include "cli/options/option_parts.h"
#include "job/paths.h"

namespace parity::cli {

void addPlotOptions(CLI::App& app, RawPlotOptions& raw) {
  PlotCommand& plot = raw.plot;
  choose(app.add_option("what", plot.what, "env-brdf: the environment BRDF of two paths, and their difference"),
         {"env-brdf"})
      ->required();
  app.add_option("scene", plot.scene, "Scene file or builtin:NAME: also show the difference on its materials")
      ->type_name(kSceneFile);
  plot.folder = "parity-plot";
  app.add_option("-o,--output", plot.folder, "Folder for pictures (PNG) and numbers (CSV)")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->capture_default_str();
  std::vector<std::string> knobs = {"paths", "max-image", "max-memory"};
  for (const paths::Path* path : job::allPaths())
    for (const std::string& id : path->environmentBrdfKnobs()) knobs.push_back(id);
  addFormulaKnobs(app, knobs, raw.given);
  app.add_option("--threads", plot.threads, "CPU threads; 0: all cores")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", plot.quiet, "Print errors only, no table")->group(kGeneralGroup);
}

PlotCommand settlePlot(const RawPlotOptions& raw) {
  PlotCommand plot = raw.plot;
  plot.settings = job::withKnobs({}, raw.given);
  return plot;
}

} // namespace parity::cli
