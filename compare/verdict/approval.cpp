#include "compare/verdict/approval.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "compare/verdict/wording.h"

namespace parity::compare {
namespace {

// How much worse `figure` is than `value`; negative: better. One of the other sign is another difference, whatever its
// size.
double worseBy(Better better, double value, double figure) {
  if (figure == value) return 0; // also of infinities
  switch (better) {
  case Better::lower:
    return figure - value;
  case Better::higher:
    return value - figure;
  case Better::nearZero:
    return figure * value < 0 ? INFINITY : std::abs(figure) - std::abs(value);
  }
  return NAN;
}

// From how much better on the approved value says nothing any more.
double farFrom(const Approval& approval) { return std::max(approval.slack, std::abs(approval.value) / 10); }

} // namespace

std::string originOf(const Approvals& approvals, const Approval& approval) {
  return fmt::format("{}, line {}", std::filesystem::path(approvals.file).filename().string(), approval.line);
}

double mostOf(const Approval& approval, Better better) {
  switch (better) {
  case Better::lower:
    return approval.value + approval.slack;
  case Better::higher:
    return approval.value - approval.slack;
  case Better::nearZero:
    return std::abs(approval.value) + approval.slack;
  }
  return NAN;
}

AppliedApproval applyApproval(const Approval& approval, const std::string& origin, double figure,
                              const std::string& inputs, base::Day asOf) {
  const Statistic statistic = requireStatistic(approval.metric, origin);
  AppliedApproval applied{.origin = origin,
                          .value = approval.value,
                          .slack = approval.slack,
                          .until = base::textOf(approval.until),
                          .daysLeft = base::daysBetween(asOf, approval.until),
                          .owner = approval.owner,
                          .reason = approval.reason};
  const auto lapse = [&](std::string why) {
    applied.state = ApprovalState::lapsed;
    applied.words = std::move(why);
    return applied;
  };
  const std::string value = formatFigure(approval.metric, approval.value);
  if (inputs != approval.inputs)
    return lapse(fmt::format("it is for another asset or environment (inputs {}, now {})", approval.inputs,
                             inputs.empty() ? "not known" : inputs));
  if (applied.daysLeft < -kGraceDays) return lapse(fmt::format("it expired on {}", applied.until));
  const double worse = worseBy(statistic.better, approval.value, figure);
  if (statistic.better == Better::nearZero && figure * approval.value < 0)
    return lapse(fmt::format("its sign has changed: {} was approved", value));
  const double rounding = 1e-12 * (std::abs(approval.value) + approval.slack); // 0.26 is 0.25 and 0.01
  if (!(worse <= approval.slack + rounding)) {
    CheckResult beyond;
    beyond.metric = approval.metric;
    beyond.value = figure;
    beyond.failAbove = mostOf(approval, statistic.better);
    beyond.verdict = Verdict::fail;
    return lapse(fmt::format("{}, which is what it allows", describeCheck(beyond)));
  }
  if (applied.daysLeft < 0) {
    applied.state = ApprovalState::expired;
    applied.words = fmt::format("its approval expired on {} and no longer covers it from {} on", applied.until,
                                base::textOf(approval.until + std::chrono::days(kGraceDays + 1)));
  } else if (-worse > farFrom(approval)) {
    applied.state = ApprovalState::loose;
    applied.words = fmt::format("tighten its approval: {} {} is far better than the approved {}", statistic.label,
                                formatFigure(approval.metric, figure), value);
  }
  return applied;
}

std::string describeApproval(const AppliedApproval& approval) {
  std::string days;
  if (approval.daysLeft >= 0 && approval.daysLeft <= kToldDaysBefore)
    days = approval.daysLeft == 0
               ? " (today is the last day)"
               : fmt::format(" ({} day{} left)", approval.daysLeft, approval.daysLeft == 1 ? "" : "s");
  return fmt::format("approved until {}{} by {}: {} ({})", approval.until, days, approval.owner, approval.reason,
                     approval.origin);
}

} // namespace parity::compare
