// Approvals: figures beyond a limit that somebody accepts until a day. One entry for each figure of each row; the file
// lies in the user's repository (docs/approvals.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/day.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/check.h"

namespace parity::compare {

// How many days before its end an approval is said to end, and how many days after it only warns.
inline constexpr int kToldDaysBefore = 14, kGraceDays = 7;
// Digits of the digest of a scene's inputs.
inline constexpr std::size_t kInputDigits = 12;

struct Approval {
  std::string scene, view;
  std::string material; // empty: the view's whole image
  std::string metric;   // a figure, by its canonical name: "flip.mean"
  double value = 0;     // the figure that is accepted
  double slack = 0;     // how much worse it may be
  base::Day until;      // the last day on which it holds
  std::string owner, reason;
  std::string inputs; // digest of the scene's asset and environment (report::approvedInputs): others are not covered
  int line = 0;       // in its file; 0: it is in none yet
};

struct Approvals {
  std::string file;              // as it was given
  std::string head;              // the comments before its first key, with their line feeds
  std::string numerics;          // of the machine whose figures these are; empty: not said
  std::vector<Approval> entries; // in the order of the file
};

// Reads approvals. Throws Error (exit 4) "file: line N: reason" for: a merge conflict marker; a syntax error; an
// unknown key or metric (with the nearest known name); a wrong type; a missing key; a value outside its figure's range,
// or so near its end that nothing is beyond it; a date that is none; a digest that is none; two entries for one figure.
Approvals loadApprovals(const std::filesystem::path& file);
// The same of the text of that file, which is not read.
Approvals readApprovals(std::string_view text, const std::filesystem::path& file);

// As TOML: the head, the numerics id, the entries sorted by scene, view, material (whole images first) and metric.
std::string formatApprovals(const Approvals& approvals);

// "approvals.toml, line 12": as reports name it.
std::string originOf(const Approvals& approvals, const Approval& approval);

// The worst value that the approval covers.
double mostOf(const Approval& approval, Better better);

// Holds a figure against an approval of it. inputs: digest of the scene's, empty where it is not known. asOf: the day
// of the run.
AppliedApproval applyApproval(const Approval& approval, const std::string& origin, double figure,
                              const std::string& inputs, base::Day asOf);

// "approved until 2027-02-01 (9 days left) by characters: refit in sprint 12 (approvals.toml, line 12)".
std::string describeApproval(const AppliedApproval& approval);

} // namespace parity::compare
