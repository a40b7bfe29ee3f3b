// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/plot_options.h"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>

#include "base/text/nearest.h"
#include "cli/options/knob_options.h"
#include "job/paths.h"

namespace parity::cli {

void addPlotOptions(CLI::App& app, RawPlotOptions& raw) {
  PlotCommand& plot = raw.plot;
  app.add_option("what", plot.what, "env-brdf: the environment BRDF of two paths, and their difference")
      ->required()
      ->check(CLI::Validator(
          [](const std::string& name) {
            constexpr std::string_view kKnown[] = {"env-brdf"};
            return name == kKnown[0] ? std::string() : name + ": unknown plot; " + base::describeNearest(name, kKnown);
          },
          "NAME"));
  app.add_option("scene", plot.scene, "Scene file or builtin:NAME: also show the difference on its materials");
  app.add_option("-o,--output", plot.folder, "Folder for pictures (PNG) and numbers (CSV)")->required();
  std::vector<std::string> knobs = {"paths"};
  for (const paths::Path* path : job::allPaths())
    for (const std::string& id : path->environmentBrdfKnobs()) knobs.push_back(id);
  addFormulaKnobs(app, knobs, raw.given);
  app.add_option("--threads", plot.threads, "CPU threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", plot.quiet, "Print errors only, no table");
}

PlotCommand settlePlot(const RawPlotOptions& raw) {
  PlotCommand plot = raw.plot;
  plot.settings = job::withKnobs({}, raw.given);
  return plot;
}

} // namespace parity::cli
