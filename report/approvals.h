// Approvals applied to a report, and made from one.
#pragma once

#include <string>
#include <vector>

#include "compare/verdict/approval.h"
#include "report/report.h"

namespace parity::report {

// The digest of a scene's asset and environment, as approvals hold it: 12 hexadecimal digits; empty where they are not
// known.
std::string approvedInputs(const std::optional<SceneInputs>& inputs);

// Which of the entries this run must have rows for.
enum class EntriesFor {
  all,    // each: the run is whole
  scenes, // those of its scenes
  none    // nobody knows: --only or --material left some out
};

// Sets the approval of each check whose figure has an entry, and what the report says of the file. Entries whose row
// is not there or not seen, and those that expired and are not needed, are one warning of the report. The verdicts are
// settleVerdicts' matter.
void applyApprovals(Report& report, const compare::Approvals& approvals, base::Day asOf, EntriesFor entriesFor);

// Of the approvals that rows pass by, or failed to: those that end within kToldDaysBefore days or have ended, the first
// first.
struct ExpiringApproval {
  std::string scene, view, material, metric; // material empty: the whole image
  const compare::AppliedApproval* approval = nullptr;
};
std::vector<ExpiringApproval> expiringApprovals(const Report& report);

struct ApproveRequest {
  std::vector<std::string> materials, scenes, views; // globs; scenes and views empty: all
  std::vector<std::string> metrics;                  // canonical names; empty: all that are beyond a limit
  bool wholes = false;                               // whole images, too
  bool warnings = false;                             // also rows that warn
  std::string owner, reason;
  base::Day until;
  double slack = 0.01; // share of the figure
};

struct ApproveResult {
  std::vector<compare::Approval> entries; // in the order of the report
  std::vector<std::string> refused;       // rows that were asked for and cannot be approved, with the reason
};

// Entries for the figures beyond a limit of the rows that fail. Values have four significant digits. Nothing is made
// for NaN or infinite pixels, for rows that are errors or not seen, and for figures that cannot be worse. The report
// must have been read with its checks (ReadDepth::checks).
ApproveResult approveRows(const Report& report, const ApproveRequest& request);

// The entries with others: of the same figure the later one takes the earlier one's place.
struct MergedApprovals {
  std::size_t added = 0, replaced = 0;
};
MergedApprovals mergeApprovals(compare::Approvals& approvals, const std::vector<compare::Approval>& entries);

} // namespace parity::report
