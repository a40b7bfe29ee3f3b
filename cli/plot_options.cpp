// By CLI11, as command_line.cpp, which it serves.
#include "cli/plot_options.h"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>

#include "base/nearest.h"
#include "cli/option_parts.h"

namespace parity::cli {

void addPlotOptions(CLI::App& app, RawPlotOptions& raw) {
  PlotCommand& plot = raw.plot;
  app.add_option("what", plot.what, "env-brdf: the environment BRDF of high-end's table and of mobile's approximation")
      ->required()
      ->check(CLI::Validator(
          [](const std::string& name) {
            constexpr std::string_view kKnown[] = {"env-brdf"};
            return name == kKnown[0] ? std::string() : name + ": no such plot; " + base::describeNearest(name, kKnown);
          },
          "NAME"));
  app.add_option("scene", plot.scene, "Scene file or builtin:NAME: also how far the two are apart on its materials");
  app.add_option("-o,--output", plot.folder, "Folder of the pictures (PNG) and numbers (CSV)")->required();
  addSetting(app, "--geometry-term", raw.geometryTerm, plot.highend.geometryTerm, highend::geometryTermNames(),
             "Geometry term of the table");
  addSetting(app, "--fresnel", raw.fresnel, plot.highend.fresnel, highend::fresnelNames(),
             "Fresnel's curve of the table");
  addSetting(app, "--compensation", raw.compensation, plot.highend.compensation, highend::compensationNames(),
             "What high-end adds for light that scatters more than once; apart from all else");
  app.add_option("--mobile-preset", raw.mobilePreset, "Whose approximation")
      ->check(CLI::IsMember(mobile::presetNames()))
      ->capture_default_str();
  app.add_option("--threads", plot.threads, "CPU threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", plot.quiet, "Errors only: no table either");
}

PlotCommand settlePlot(const RawPlotOptions& raw) {
  PlotCommand plot = raw.plot;
  plot.highend.geometryTerm = enumOf<highend::GeometryTerm>(raw.geometryTerm, highend::geometryTermNames());
  plot.highend.fresnel = enumOf<highend::FresnelCurve>(raw.fresnel, highend::fresnelNames());
  plot.highend.compensation = enumOf<highend::Compensation>(raw.compensation, highend::compensationNames());
  plot.mobile = mobile::presetByName(raw.mobilePreset);
  return plot;
}

} // namespace parity::cli
