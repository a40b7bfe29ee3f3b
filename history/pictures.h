// Pictures of rows, kept by their content: `pictures/9f/9f3c....png` in a history's folder, each content once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "history/database.h"
#include "history/run.h"

namespace parity::history {

enum class KeptPictures { all, notPassed, none }; // of which rows

// Copies those of a report's rows, and says in the record what they are. A picture that the report lacks is not kept.
// Throws Error (exit 4) where one cannot be written.
void keepPictures(const std::filesystem::path& history, const std::filesystem::path& reportFolder,
                  const report::Report& report, KeptPictures which, RunRecord& record);

struct Collected {
  std::size_t kept = 0, removed = 0;
  std::uintmax_t keptBytes = 0, removedBytes = 0;
};

// Removes pictures, but for those of runs since `since` (ISO 8601, UTC), and of the first and the last run of each
// interval of a row's verdict. The history must be locked. isTrial: removes nothing. Throws Error.
Collected collectPictures(const Database& index, const std::filesystem::path& history, const std::string& since,
                          bool isTrial);

} // namespace parity::history
