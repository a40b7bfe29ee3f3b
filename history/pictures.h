// Pictures of rows, kept by their content: `pictures/9f/9f3c....png` in a history's folder, each content once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "compare/verdict/approval.h"
#include "history/database.h"
#include "history/run.h"

namespace parity::history {

// The file of a picture by its hash. Reports make no other pictures than PNG.
std::filesystem::path pictureFile(const std::filesystem::path& history, const std::string& hash);

enum class KeptPictures { all, notPassed, none }; // of which rows

// Copies those of a report's rows, and says in the record what they are. A picture that the report lacks is not kept.
// Throws Error (exit 4) where one cannot be written.
void keepPictures(const std::filesystem::path& history, const std::filesystem::path& reportFolder,
                  const report::Report& report, KeptPictures which, RunRecord& record);

struct Collected {
  std::size_t kept = 0, removed = 0;
  std::uintmax_t keptBytes = 0, removedBytes = 0;
};

// Removes pictures, but for those of runs since `since` (ISO 8601, UTC), of the first and the last run of each interval
// of a row's verdict, and of the states that are approved. The history must be locked. isTrial: removes nothing. Throws
// Error.
Collected collectPictures(const Database& index, const std::filesystem::path& history, const std::string& since,
                          const compare::Approvals& approvals, bool isTrial);

} // namespace parity::history
