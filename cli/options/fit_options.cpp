// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/fit_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/knob_options.h"
#include "cli/options/option_parts.h"
#include "highend/options.h"

namespace parity::cli {

void addFitOptions(CLI::App& app, RawFitOptions& raw) {
  addFormulaKnobs(app, {"geometry-term", "fresnel", "compensation"}, raw.given);
  choose(app.add_option("--format", raw.fit.format, "Format of the constants: glsl, hlsl or json"),
         {"glsl", "hlsl", "json"})
      ->group(kOutputGroup)
      ->capture_default_str();
  app.add_option("-o,--output", raw.fit.output, "File to write. Default: stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);
  app.add_option("--threads", raw.fit.threads, "CPU threads; 0: all cores. The result does not depend on it")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.fit.quiet, "Print errors only")->group(kGeneralGroup);
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
