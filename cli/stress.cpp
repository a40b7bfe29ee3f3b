// parity stress: every shading function over its domain, and whole renders at the edges.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "gpu/device/device.h"
#include "job/knobs.h"

namespace parity::cli {

namespace {

int printAt(const StressCommand& command) {
  const stress::At at = stress::parseAt(command.at);
  std::unique_ptr<gpu::Device> device;
  if (command.options.points.devicePoints > 0) device = std::make_unique<gpu::Device>(command.options.render.device);
  print("{}", stress::describeAt(at, device.get()));
  return 0;
}

} // namespace

int runStressCommand(const StressCommand& command) {
  if (command.quiet) base::setLogLevel(base::LogLevel::quiet);
  const base::ThreadLimit threads(command.threads);
  if (command.list) {
    print("{}", stress::formatList(command.options));
    return 0;
  }
  if (!command.at.empty()) return printAt(command);
  std::error_code problem; // found before the minutes that follow
  if (!command.folder.empty()) std::filesystem::create_directories(command.folder, problem);
  if (problem) throw base::fileError(command.folder, "", problem.message());
  stress::Options options = command.options;
  for (const auto& [knob, presets] : command.presets)
    for (const std::string& preset : presets) {
      const job::Settings settings = job::withKnobs({}, {{knob, {{preset}, "--" + knob}}});
      options.render.presets.push_back(job::knobs().find(knob)->text(settings));
    }
  const stress::Report report = stress::runStress(options, makeProgress(command.quiet));
  if (!command.folder.empty()) {
    const std::filesystem::path folder = command.folder;
    base::writeText(folder / "stress.json", stress::formatJson(report));
    writePage(folder, stress::formatPage(report));
  }
  if (!command.json.empty()) writeJson(command.json, stress::formatJson(report));
  if (command.json != "-" && !command.quiet) {
    print("{}", stress::formatReport(report));
    if (!command.folder.empty()) printPage(command.folder, "stress.json");
  }
  if (!report.failure.empty()) {
    base::logError(report.failure);
    return static_cast<int>(base::ExitCode::failed);
  }
  return static_cast<int>(report.unexpected() > 0 ? base::ExitCode::overBudget : base::ExitCode::withinBudget);
}

} // namespace parity::cli
