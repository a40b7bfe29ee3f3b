// By CLI11, as command_line.cpp, which it serves.
#include "cli/fit_options.h"

#include <algorithm>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/option_parts.h"
#include "highend/renderer.h"

namespace parity::cli {

namespace {

template <typename Enum> Enum settingOf(const std::string& text, const std::vector<std::string>& names) {
  return static_cast<Enum>(std::find(names.begin(), names.end(), text) - names.begin());
}

} // namespace

void addFitOptions(CLI::App& app, RawFitOptions& raw) {
  const fit::Settings defaults;
  addSetting(app, "--geometry-term", raw.geometryTerm, defaults.geometryTerm, highend::geometryTermNames(),
             "Geometry term of your high-end path");
  addSetting(app, "--fresnel", raw.fresnel, defaults.fresnel, highend::fresnelNames(), "Its Fresnel curve");
  addSetting(app, "--compensation", raw.compensation, defaults.compensation, highend::compensationNames(),
             "What returns the light that its single scattering loses");
  app.add_option("--format", raw.fit.format, "Constants as glsl, hlsl or json")
      ->check(CLI::IsMember({"glsl", "hlsl", "json"}))
      ->capture_default_str();
  app.add_option("-o,--output", raw.fit.output, "File to write. Default: stdout");
  app.add_option("--threads", raw.fit.threads, "CPU threads; 0: all cores; the result is the same")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.fit.quiet, "Errors only");
}

FitCommand settleFit(const RawFitOptions& raw) {
  FitCommand command = raw.fit;
  command.settings.geometryTerm = settingOf<fit::GeometryTerm>(raw.geometryTerm, highend::geometryTermNames());
  command.settings.fresnel = settingOf<fit::FresnelCurve>(raw.fresnel, highend::fresnelNames());
  command.settings.compensation = settingOf<fit::Compensation>(raw.compensation, highend::compensationNames());
  return command;
}

} // namespace parity::cli
