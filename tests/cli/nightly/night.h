// What the tests of plan, work and merge share: a night of small scenes, and its report by any way.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/checks.h"

namespace parity::tests {

using Files = std::map<std::string, std::string>;

class NightTest : public RenderingTest {
protected:
  // Quads of other colours and roughness: 00.gltf, 01.gltf, ... and a suite of them all, which options() names.
  void writeScenes(int count) const;
  // Of the suite, for `report` and `plan`: small pictures under the validation layer, which recalls no results.
  std::vector<std::string> options() const;

  // Files of a report that must be the same however it was made: all but those that hold the date.
  static Files filesOf(const std::filesystem::path& folder);
  // The report that one process makes. It stays in the folder "plain".
  Files reportHere() const;
  Files reportIn(const std::string& folder) const { return filesOf(m_folder / folder); }

  RunResult plan(int shards, const std::vector<std::string>& more = {}) const;
  RunResult work(const std::vector<std::string>& more = {}, const RunOptions& options = {}) const;
  RunResult merge(const std::string& to, const std::vector<std::string>& more = {},
                  const RunOptions& options = {}) const;

  // Merges the plan, and expects a report of these files.
  void expectMerged(const Files& expected, const std::string& to = "merged") const;

  // The environment in which processes fail; `faults` as PARITY_FAULTS of faults.cpp. once: each happens one time.
  RunOptions failing(const std::string& faults, bool once) const;
  // The scenes that workers began, as "PID FILE", each once; of processes that failing() surrounds.
  std::vector<std::string> begun() const;

  // Names of the units that are there, sorted.
  std::vector<std::string> units() const;
  nlohmann::json planFile() const { return nlohmann::json::parse(readWholeFile(m_folder / "night" / "plan.json")); }
};

// The pictures and figures are the same, file by file. Names the first files that differ.
testing::AssertionResult sameFiles(const Files& files, const Files& expected);

} // namespace parity::tests
