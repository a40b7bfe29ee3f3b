// Which commit a run is of: as options say, else as the environment of CI says, else as git says.
#pragma once

#include <filesystem>
#include <string>

#include "history/run.h"

namespace parity::cli {

// given: what options say; each empty part is looked for. repository: a folder of the work tree. What nobody knows is
// empty.
history::CommitInfo commitInfo(history::CommitInfo given, const std::filesystem::path& repository);

} // namespace parity::cli
