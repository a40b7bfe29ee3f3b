// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/fit_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/knob_options.h"
#include "highend/options.h"

namespace parity::cli {

void addFitOptions(CLI::App& app, RawFitOptions& raw) {
  addFormulaKnobs(app, {"geometry-term", "fresnel", "compensation"}, raw.given);
  app.add_option("--format", raw.fit.format, "Format of the constants: glsl, hlsl or json")
      ->check(CLI::IsMember({"glsl", "hlsl", "json"}))
      ->capture_default_str();
  app.add_option("-o,--output", raw.fit.output, "File to write. Default: stdout");
  app.add_option("--threads", raw.fit.threads, "CPU threads; 0: all cores. The result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.fit.quiet, "Print errors only");
}

FitCommand settleFit(const RawFitOptions& raw) {
  FitCommand command = raw.fit;
  const job::Settings settings = job::withKnobs({}, raw.given);
  const auto& path = settings.of<highend::Options>();
  command.settings.geometryTerm = path.model.geometryTerm;
  command.settings.fresnel = path.model.fresnel;
  command.settings.compensation = path.compensation;
  return command;
}

} // namespace parity::cli
