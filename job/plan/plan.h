// The plan of a run over many machines: what is compared, how, and in which shard. docs/nightly.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "job/report_end.h"
#include "job/report_run.h"
#include "job/run_budgets.h"

namespace parity::job {

inline constexpr std::size_t kMostShards = 1000;

// Everything that decides the bytes of the report is frozen in it, besides the files that scenes are read from.
struct Plan {
  std::string version, build, numerics; // of parity, of the binary, of the machine (job/numerics.h)
  RunFacts facts;
  Settings plain;                               // of the run, without its knobs
  base::GivenKnobs given;                       // its knobs
  ReportRequest request;                        // without folder and bench
  FrozenFiles budgets;                          // the text of each budget file, and of the approvals
  std::string baseline;                         // content of the baseline's report.json: its hash; empty: none
  std::vector<std::string> sceneBaselines;      // hash of what the baseline says of each scene; empty: nothing
  std::vector<std::vector<std::size_t>> shards; // places of scenes, the longest first; together each once
  std::string
      digest; // hash of what decides the report: not of the shards; set by writePlan and readPlan (plan_folder.h)

  Settings settings() const; // of scenes that say nothing else
};

// Freezes a run of this machine: makes the device, reads budgets and times of earlier runs. shards: 1 to kMostShards;
// of fewer scenes than that some are empty. Throws Error for what concerns the whole run.
Plan makePlan(Context& context, ReportRequest request, const Settings& plain, const base::GivenKnobs& given,
              std::size_t shards);

// What the cache will take for the results of all scenes, bytes, about: 12 for each pixel of each view, as a view of
// five materials took at 768x768; without pictures next to nothing.
std::uintmax_t expectedCacheBytes(const ReportRequest& request);

// Puts the scenes into shards, the longest first, each where the least is to do. seconds: of each scene; empty: all are
// taken as equal.
std::vector<std::vector<std::size_t>> packShards(std::size_t scenes, const std::vector<double>& seconds,
                                                 std::size_t shards);

} // namespace parity::job
