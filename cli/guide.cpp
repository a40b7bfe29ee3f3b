// parity completion and man: texts about the command line itself, to stdout or as files.
#include <filesystem>

#include "base/file.h"
#include "cli/invocation.h"
#include "cli/output.h"

namespace parity::cli {

int runGuideCommand(const GuideCommand& command) {
  for (const auto& [name, text] : command.files) base::writeText(std::filesystem::path(command.folder) / name, text);
  if (!command.text.empty()) printText(command.text);
  return 0;
}

} // namespace parity::cli
