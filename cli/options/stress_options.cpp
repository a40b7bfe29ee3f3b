// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/stress_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/option_parts.h"
#include "job/paths.h"

namespace parity::cli {

void addStressOptions(CLI::App& app, RawStressOptions& raw) {
  stress::Options& options = raw.stress.options;
  choose(app.add_option("--only", raw.only, "Part to run: functions or renders. Default: both"),
         {"functions", "renders"})
      ->group("Parts");
  app.add_flag("--list", raw.stress.list, "List the functions with their inputs and requirements, and the scenes")
      ->group("Parts");
  app.add_option("--at", raw.stress.at,
                 "FUNCTION:in1,in2,...: evaluate one input in every precision, on CPU and device, and print all bits")
      ->type_name("FUNCTION:VALUES")
      ->group("Parts")
      ->excludes("--list");

  app.add_option("--functions", options.functionGlob, "Run only functions whose names match this glob")
      ->type_name("GLOB")
      ->capture_default_str()
      ->group("Functions");
  app.add_option("--points", options.points.points,
                 "Low-discrepancy points for each function, in addition to the special values")
      ->check(wholeWithin(0, 4'000'000'000))
      ->capture_default_str()
      ->group("Functions");
  app.add_option("--device-points", options.points.devicePoints,
                 "Points for each function on the device; a software device is slow. 0: do not run on the device")
      ->check(wholeWithin(0, 4'000'000'000))
      ->capture_default_str()
      ->group("Functions");

  app.add_option("--renders", options.renderGlob, "Run only scenes whose names match this glob, such as random-SEED")
      ->type_name("GLOB")
      ->capture_default_str()
      ->group("Renders");
  for (const paths::Path* path : job::allPaths())
    if (const std::string knob = path->presetKnob(); !knob.empty())
      repeat(app.add_option("--" + knob, raw.stress.presets[knob],
                            "Render only these presets of the path, folders too (repeatable). Default: all"))
          ->type_name("PRESET")
          ->group("Renders");
  app.add_option("--scenes", options.scenes, "Number of random scenes")
      ->check(wholeWithin(0, 1'000'000))
      ->capture_default_str()
      ->group("Renders");
  app.add_option("--seed", options.seed, "Seed of the first random scene; each next scene adds 1")
      ->capture_default_str()
      ->group("Renders");
  app.add_option("--seconds", options.seconds, "Soak test: render random scenes for this many seconds")
      ->check(within(0, 1e7))
      ->excludes("--scenes")
      ->group("Renders");

  app.add_option("-o,--output", raw.stress.folder, "Folder for index.html and stress.json")
      ->type_name(kFolder)
      ->group(kOutputGroup);
  app.add_option("--json", raw.stress.json, "Write stress.json to this file; - for stdout, instead of the tables")
      ->type_name(kFile)
      ->group(kOutputGroup);
  app.add_option("--device", options.render.device.name,
                 "Vulkan device: part of its name, or its number from 'parity devices'. Default: the software device")
      ->type_name("DEVICE")
      ->group(kMachineGroup);
  app.add_flag("--no-validation", raw.noValidation,
               "Run without the Khronos validation layer. With it, each of its messages fails the run")
      ->group(kMachineGroup);
  app.add_option("--threads", raw.stress.threads, "CPU threads; 0: all cores. The result does not depend on it")
      ->group(kMachineGroup)
      ->check(wholeWithin(0, 1024))
      ->capture_default_str();
  app.add_flag("-q,--quiet", raw.stress.quiet, "Print errors only")->group(kGeneralGroup);
}

StressCommand settleStress(const RawStressOptions& raw) {
  StressCommand command = raw.stress;
  command.options.functions = raw.only != "renders";
  command.options.renders = raw.only != "functions";
  command.options.render.device.validation = !raw.noValidation;
  return command;
}

} // namespace parity::cli
