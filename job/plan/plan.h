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

// Where `parity work` keeps what it has done, below the plan's folder.
inline constexpr const char* kPlanFile = "plan.json";
// The plan of `report --jobs`, in the report's folder.
inline constexpr const char* kWorkFolder = ".parity-work";
inline constexpr std::size_t kMostShards = 1000;

// Everything that decides the bytes of the report is frozen in it, besides the files that scenes are read from.
struct Plan {
  std::string version, build, numerics; // of parity, of the binary, of the machine (job/numerics.h)
  RunFacts facts;
  Settings plain;                               // of the run, without its knobs
  base::GivenKnobs given;                       // its knobs
  ReportRequest request;                        // without folder and bench
  FrozenFiles budgets;                          // the text of each budget file
  std::string baseline;                         // content of the baseline's report.json: its hash; empty: none
  std::vector<std::string> sceneBaselines;      // hash of what the baseline says of each scene; empty: nothing
  std::vector<std::vector<std::size_t>> shards; // places of scenes, the longest first; together each once
  std::string digest; // hash of what decides the report: not of the shards; set by writePlan and readPlan

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

// Writes plan.json, and the baseline beside it; sets the digest. A folder that holds the same plan keeps what was done
// for it, but for scenes that failed or whose files have changed since. Throws Error: usage where the folder holds
// another plan; (exit 4) where it cannot be written.
void writePlan(Plan& plan, const std::filesystem::path& folder);

// The same for a folder that nobody else uses: what an other plan has left there goes.
void writePlanAnew(Plan& plan, const std::filesystem::path& folder);

// Throws Error (exit 4) for a file that is missing or no plan; (exit 78) for one of another version or build.
Plan readPlan(const std::filesystem::path& folder);

// The copy of the baseline's report.json, and what it says of the scene at this place: an empty path where that is
// nothing. Throws Error (exit 78) where the copy is not the one that was planned, or not there.
std::filesystem::path baselineOf(const Plan& plan, const std::filesystem::path& folder);
std::filesystem::path baselineOf(const Plan& plan, const std::filesystem::path& folder, std::size_t scene);

// One process at a time merges a plan. On a folder that is read-only there is no lock.
class PlanLock {
public:
  // Throws Error (exit 75) where another process holds it.
  explicit PlanLock(const std::filesystem::path& folder);
  ~PlanLock();
  PlanLock(const PlanLock&) = delete;
  PlanLock& operator=(const PlanLock&) = delete;

private:
  int m_descriptor;
};

} // namespace parity::job
