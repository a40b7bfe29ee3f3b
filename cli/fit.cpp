// parity fit: the constants of the mobile preset refit, for a high-end path with other settings than ours.
#include <fmt/format.h>

#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "study/fit/refit.h"
#include "study/fit/refit_text.h"

namespace parity::cli {

int runFitCommand(const FitCommand& command) {
  if (command.quiet) base::setLogLevel(base::LogLevel::quiet);
  const base::ThreadLimit threads(command.threads);
  const fit::Refit refit =
      fit::fitRefit(command.settings, [](const std::string& what) { base::logInfo("fit: " + what); });
  base::logDetail(
      fmt::format("fit: worst error of the environment's read: {:.4f}; of one read at the roughness {:.4f}, "
                  "in the dominant direction {:.4f}",
                  refit.tapError, refit.mirrorError, refit.dominantError));
  const std::string text =
      command.format == "json"
          ? fit::formatJson(refit)
          : fit::formatShader(refit, command.format == "hlsl" ? fit::Language::hlsl : fit::Language::glsl);
  if (command.output.empty())
    print("{}", text);
  else
    base::writeText(command.output, text);
  return 0;
}

} // namespace parity::cli
