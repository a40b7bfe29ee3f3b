// One figure held against one limit, and the words for what came of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/verdict/accept.h"

namespace parity::compare {

// In order of gravity; the worst of its parts is the verdict of a whole.
enum class Verdict { pass, notSeen, tooSmall, notJudged, warn, fail, notRun, error };
// "pass", "not seen", "too small" (fewer pixels than the budget's min_pixels), "not judged" (most pixels are clipped in
// both pictures), "warn", "fail", "not run" (a scene that an interrupted run did not finish), "error".
const char* nameOf(Verdict verdict);

// What an approval is worth for a figure on the day of the run.
enum class ApprovalState {
  holds,   // it covers the figure
  loose,   // the same, but the figure is far better by now: a warning
  expired, // it covers it for some days more: a warning
  lapsed   // it does not cover it
};
const char* nameOf(ApprovalState state); // as above

// An approval (compare/verdict/approval.h) of the figure of a check.
struct AppliedApproval {
  std::string origin = {}; // "approvals.toml, line 12"
  ApprovalState state = ApprovalState::holds;
  double value = 0, slack = 0; // what is approved, and how much worse the figure may be
  std::string until = {};      // ISO 8601
  int daysLeft = 0;            // until then; negative: days since
  std::string owner = {}, reason = {};
  std::string words = {}; // why it warns or does not hold; empty: it holds
};

// One budget check: `metric` names a figure ("flip.mean", "psnr", ...; compare/pooling/statistic.h).
struct CheckResult {
  std::string metric;
  bool regress = false; // `value` is not the figure but by how much it is worse than in the baseline (negative: better)
  double value = 0;     // NaN where it is not known
  std::optional<double> warnAbove, failAbove; // of a figure of which more is better, not of a regression: below
  Verdict verdict = Verdict::pass;
  std::string note;     // not empty where the value is not known: why
  std::string unjudged; // not empty: there was nothing to judge by (a regression without a baseline), this says why;
                        // the verdict then is what that is worth where nothing else judges
  std::optional<AppliedApproval> approval = {}; // of its figure; the verdict here is that of the limits alone
  bool judged() const { return unjudged.empty(); }
};

// Why a check is not judged: its figures hold the worst value at such pixels.
inline constexpr const char* kNonFinitePixels = "some of its pixels are NaN or infinite";

// FLIP's filters are 21 pixels wide: of fewer pixels than these its mean says little.
inline constexpr std::uint64_t kDefaultMinPixels = 64;

// The budget rule that judged something.
struct AppliedRule {
  std::string origin;        // "built-in", or "budgets.toml, line 12"; empty where no rule matched
  std::string reason, owner; // why these limits, and whose they are; may be empty
  bool requireSeen = false;
  std::uint64_t minPixels = kDefaultMinPixels; // a material of fewer is too small to be judged
  std::string file;                // as the user named it, for annotations: may be absolute, so it is in no report
  int line = 0;                    // in it; 0: the rule stands in no file
  std::string preset = {};         // whose limits it took; empty: none, all are its own
  std::vector<Accept> accept = {}; // what of it is accepted for that reason
  std::optional<std::uint64_t> maxNonFinite = {}; // NaN and infinite pixels in a view that are accepted
  bool accepts(Accept what) const;
};

// From which share of clipped pixels (Figures::clipped) on a row warns, and above which a material is not judged.
inline constexpr double kNotableClipping = 0.05, kMostClipping = 0.5;

} // namespace parity::compare
