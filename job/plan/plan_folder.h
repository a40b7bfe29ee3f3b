// The folder of a plan: plan.json, the baseline beside it, and who may merge.
#pragma once

#include <cstddef>
#include <filesystem>

#include "base/file_lock.h"
#include "job/plan/plan.h"

namespace parity::job {

inline constexpr const char* kPlanFile = "plan.json";
// The plan of `report --jobs`, in the report's folder.
inline constexpr const char* kWorkFolder = ".parity-work";

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

private:
  base::FileLock m_lock;
};

} // namespace parity::job
