// Run files: one immutable compressed file a run, `runs/ID.json.gz`. They are the truth; all else is made from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "history/run.h"

namespace parity::history {

inline constexpr const char *kRunFolder = "runs", *kRunEnd = ".json.gz";

struct EncodedRun {
  std::string id; // "20261125T030012Z-3f9a12c4d5e6": when it started, and of what content it is
  std::vector<std::byte> bytes;
};
EncodedRun encodeRun(const RunRecord& record);

// Throws Error (exit 4) "file: reason" where it is not whole, damaged, or of a newer version of parity.
RunRecord readRunFile(const std::filesystem::path& file);

// The ids of the runs in a history's folder, oldest first; files of other names are passed over. Throws Error (exit 4)
// where the folder cannot be listed.
std::vector<std::string> listRuns(const std::filesystem::path& history);
std::filesystem::path runFile(const std::filesystem::path& history, const std::string& id);

} // namespace parity::history
