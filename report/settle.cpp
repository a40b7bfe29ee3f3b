// From checks to verdicts: of a material, a view, a scene, the report; and the exit code.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/approval.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/earlier_runs.h"
#include "report/report.h"
#include "report/standing.h"

namespace parity::report {
namespace {

constexpr int kFirstSignal = 128; // as a shell tells that a signal ended a program

compare::Verdict worse(compare::Verdict a, compare::Verdict b) { return std::max(a, b); }

// Infinite may only be what is better the more of it there is: psnr of identical images.
bool isSound(const compare::Figure& figure) {
  if (std::isfinite(figure.value)) return true;
  const std::shared_ptr<const compare::Statistic> statistic = compare::statisticByName(figure.name);
  return figure.value == INFINITY && statistic && statistic->better == compare::Better::higher;
}

struct Judgement {
  compare::Verdict verdict = compare::Verdict::pass;
  std::string reason, accepted; // accepted: by its rule
  std::string approved = {};    // by approvals

  void add(const std::string& sentence) { reason += (reason.empty() ? "" : "; ") + sentence; }
  // Whether the rule accepts what the sentence says, which then is no reason for a verdict.
  bool accept(const compare::AppliedRule& rule, compare::Accept what, const std::string& sentence) {
    if (!rule.accepts(what)) return false;
    accepted += (accepted.empty() ? "" : "; ") + sentence;
    return true;
  }
};

// What one check is worth with its approval.
struct JudgedCheck {
  compare::Verdict verdict;
  std::string sentence, approved; // why it has the verdict; what its approval covers
};
JudgedCheck judgeCheck(const compare::CheckResult& check) {
  using compare::ApprovalState, compare::Verdict;
  JudgedCheck judged{check.verdict, compare::describeCheck(check), {}};
  if (!check.approval || !check.judged()) return judged;
  const compare::AppliedApproval& approval = *check.approval;
  const bool isOver = check.verdict == Verdict::warn || check.verdict == Verdict::fail;
  const bool isLoose = approval.state == ApprovalState::loose; // that is worth a word whatever the limits say
  if (!isOver && !(isLoose && check.verdict == Verdict::pass)) return judged;
  if (approval.state == ApprovalState::lapsed) {
    judged.sentence += fmt::format("; its approval ({}) does not hold: {}", approval.origin, approval.words);
    return judged;
  }
  if (isOver) judged.approved = fmt::format("{}, {}", judged.sentence, compare::describeApproval(approval));
  judged.verdict = approval.state == ApprovalState::holds ? Verdict::pass : Verdict::warn;
  judged.sentence = fmt::format("{} ({})", approval.words, approval.origin);
  return judged;
}

// The worst verdict of the checks that could be judged, and all sentences that have it.
Judgement judgeChecks(const std::vector<compare::CheckResult>& checks) {
  if (checks.empty()) return {compare::Verdict::error, "no budget check applies", {}};
  const bool anyJudged = std::ranges::any_of(checks, &compare::CheckResult::judged);
  Judgement judgement;
  for (const compare::CheckResult& check : checks) {
    if (anyJudged && !check.judged()) continue;
    const JudgedCheck judged = judgeCheck(check);
    if (judged.verdict > judgement.verdict) judgement.verdict = judged.verdict, judgement.reason.clear();
    if (judged.verdict == judgement.verdict && judged.verdict != compare::Verdict::pass &&
        judgement.reason.find(judged.sentence) == std::string::npos) // a limit and a regression of the same figure
      judgement.add(judged.sentence);
    if (!judged.approved.empty()) judgement.approved += (judgement.approved.empty() ? "" : "; ") + judged.approved;
  }
  if (!anyJudged) judgement.reason = "no check of its budget could be judged: " + judgement.reason;
  return judgement;
}

// By the checks, unless the rule says that nothing limits it, or accepts that none of them could be judged.
Judgement judgeByRule(const compare::Figures& figures, const std::vector<compare::CheckResult>& checks,
                      const compare::AppliedRule& rule) {
  Judgement judgement;
  if (checks.empty() && judgement.accept(rule, compare::Accept::noLimit, "no limit judges it")) return judgement;
  Judgement byChecks = judgeChecks(checks);
  // What a baseline does not show is not judged either, but that is nothing to accept.
  const bool isTooDark = std::ranges::all_of(checks, [&](const compare::CheckResult& check) {
    return !check.judged() && !compare::describeTooDark(check.metric, figures).empty();
  });
  if (isTooDark && byChecks.verdict == compare::Verdict::warn &&
      judgement.accept(rule, compare::Accept::notJudged, byChecks.reason))
    return judgement;
  return byChecks;
}

// Of pixels that are NaN or infinite nothing is judged: their number is accepted, or they fail.
Judgement judgeNonFinite(const compare::Figures& figures, const compare::AppliedRule& rule) {
  Judgement judgement;
  const std::string sentence =
      fmt::format("{} of {} pixels are NaN or infinite in one of the two renders", figures.nonFinite, figures.pixels);
  const std::uint64_t most = rule.maxNonFinite.value_or(0);
  if (figures.nonFinite <= most && judgement.accept(rule, compare::Accept::nonFinite, sentence)) return judgement;
  judgement.verdict = compare::Verdict::fail;
  judgement.reason = sentence;
  if (most > 0) judgement.reason += fmt::format(", more than max_non_finite = {} of its budget", most);
  return judgement;
}

// What holds for a material and for a whole image alike, once there is a pixel. isMaterial: most of a material may be
// clipped, so that it cannot be judged; a whole image only warns of it. checks: no longer judged where accepted pixels
// are NaN or infinite, because their figures hold the worst value there.
Judgement judgeSeen(const compare::Figures& figures, std::vector<compare::CheckResult>& checks,
                    const compare::AppliedRule& rule, const std::vector<std::string>& notModelled, bool isMaterial) {
  // Of what fails they are no reason, but its reader should know.
  const auto warn = [&](Judgement& judgement, compare::Accept what, const std::string& why) {
    if (why.empty() || judgement.accept(rule, what, why)) return;
    judgement.verdict = std::max(judgement.verdict, compare::Verdict::warn);
    judgement.add(why);
  };
  const auto warnOfParts = [&](Judgement& judgement) {
    if (!notModelled.empty())
      warn(judgement, compare::Accept::baseLayerOnly,
           fmt::format("base layer only: parity does not model {}", fmt::join(notModelled, ", ")));
  };
  if (figures.nonFinite > 0) {
    Judgement judgement = judgeNonFinite(figures, rule);
    if (judgement.verdict == compare::Verdict::pass)
      for (compare::CheckResult& check : checks) check.unjudged = compare::kNonFinitePixels;
    warnOfParts(judgement);
    return judgement;
  }
  if (const std::string unsound = findUnsound(figures); !unsound.empty())
    return {compare::Verdict::error, fmt::format("a figure is not a number: {}", unsound), {}};
  if (figures.values.empty()) return {compare::Verdict::error, "no figure was measured", {}};

  Judgement judgement = judgeByRule(figures, checks, rule);
  if (judgement.verdict == compare::Verdict::error) return judgement;
  const bool isMostlyClipped = isMaterial && figures.clipped() > compare::kMostClipping;
  const compare::Accept clipping = isMostlyClipped ? compare::Accept::notJudged : compare::Accept::clipped;
  warn(judgement, clipping, compare::describeClipping(figures));
  warnOfParts(judgement);
  // What warns of a material that is clipped for the most part is said, too: it is no verdict on it.
  if (judgement.verdict < compare::Verdict::fail && isMostlyClipped && !rule.accepts(clipping))
    judgement.verdict = compare::Verdict::notJudged;
  return judgement;
}

// A truth that is no number measured nothing: an error, whatever was judged besides.
Judgement withTruth(Judgement judgement, const std::optional<compare::Truth>& truth) {
  if (!truth || truth->figures.nonFinite == 0) return judgement;
  std::string reason = fmt::format("{} of {} pixels of the truth are NaN or infinite", truth->figures.nonFinite,
                                   truth->figures.reference.pixels);
  if (!judgement.reason.empty()) reason += "; " + judgement.reason;
  judgement.verdict = worse(judgement.verdict, compare::Verdict::error);
  judgement.reason = std::move(reason);
  return judgement;
}

// What the baseline shows under other conditions was not held against it: that is no pass.
Judgement withBaseline(Judgement judgement, const std::optional<BaselineChange>& baseline) {
  if (!baseline || baseline->notComparable.empty()) return judgement;
  judgement.verdict = worse(judgement.verdict, compare::Verdict::warn);
  if (judgement.reason.find(baseline->notComparable) != std::string::npos) return judgement; // of a check
  judgement.add("not comparable to the baseline: " + baseline->notComparable);
  return judgement;
}

// Whether so much of a material is seen that it can be judged. NaN that the rule does not accept is never too small.
bool isSeen(const compare::Figures& figures, const compare::AppliedRule& rule) {
  const std::uint64_t accepted = rule.accepts(compare::Accept::nonFinite) ? rule.maxNonFinite.value_or(0) : 0;
  return figures.pixels > 0 && (figures.pixels >= rule.minPixels || figures.nonFinite > accepted);
}
bool isSeen(const MaterialResult& material) { return isSeen(material.figures, material.rule); }

// As the material itself is judged, by its own figures.
void settleWhatIf(const MaterialResult& material, WhatIf& whatIf) {
  Judgement judgement{material.verdict, material.reason, {}};
  if (isSeen(whatIf.figures, material.rule))
    judgement = withBaseline(
        withTruth(judgeSeen(whatIf.figures, whatIf.checks, material.rule, material.notModelled, true), material.truth),
        material.baseline);
  whatIf.verdict = judgement.verdict;
  whatIf.reason = std::move(judgement.reason);
  whatIf.words = describe(whatIf, material.figures);
}

// The name of another view of the scene that shows enough of the material; empty if there is none.
std::string findOtherView(const SceneResult& scene, const ViewResult& here, std::size_t index) {
  for (const ViewResult& view : scene.views)
    if (&view != &here && index < view.materials.size() && view.materials[index].name == here.materials[index].name &&
        isSeen(view.materials[index]))
      return view.name;
  return {};
}

// "12 pixels, fewer than the 64 of its budget (min_pixels)".
std::string describeSize(const MaterialResult& material) {
  return fmt::format("{} pixel{}, fewer than min_pixels = {} of its budget", material.figures.pixels,
                     material.figures.pixels == 1 ? "" : "s", material.rule.minPixels);
}

// What has no or too few pixels, unless its budget accepts that.
Judgement judgeUnseen(const compare::AppliedRule& rule, compare::Accept what, const std::string& sentence) {
  Judgement judgement;
  if (judgement.accept(rule, what, sentence)) return judgement;
  const bool isSmall = what == compare::Accept::tooSmall;
  return {isSmall ? compare::Verdict::tooSmall : compare::Verdict::notSeen, sentence, {}};
}

// What is accepted: by its budget, with the reason that gives, and by approvals, with theirs; empty: nothing is.
std::string acceptedOf(const Judgement& judgement, const compare::AppliedRule& rule) {
  if (judgement.accepted.empty()) return judgement.approved;
  return fmt::format("{} (reason: {}){}{}", judgement.accepted, rule.reason, judgement.approved.empty() ? "" : "; ",
                     judgement.approved);
}

void settleWhole(ViewResult& view) {
  Judgement judgement;
  if (view.materials.empty())
    judgement = {compare::Verdict::error, "the view holds no material to compare", {}};
  else if (view.whole.pixels == 0)
    judgement = judgeUnseen(view.rule, compare::Accept::notSeen, "no pixel of this view shows a material");
  else
    judgement =
        withBaseline(withTruth(judgeSeen(view.whole, view.checks, view.rule, {}, false), view.truth), view.baseline);
  view.wholeVerdict = judgement.verdict;
  view.reason = std::move(judgement.reason);
  view.accepted = acceptedOf(judgement, view.rule);
}

void settleView(const SceneResult& scene, ViewResult& view) {
  settleWhole(view);
  view.verdict = view.wholeVerdict;
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    MaterialResult& material = view.materials[i];
    const std::string other = findOtherView(scene, view, i);
    settleMaterial(material, !other.empty());
    if (material.seenElsewhere)
      material.reason = fmt::format("{} in this view; view '{}' shows it",
                                    material.figures.pixels > 0 ? describeSize(material) : "not seen", other);
    if (!material.seenElsewhere) view.verdict = worse(view.verdict, material.verdict);
  }
}

void settleScene(SceneResult& scene) {
  if (scene.error.empty() && scene.views.empty()) {
    scene.error = "no view was compared";
    scene.errorExitCode = static_cast<int>(base::ExitCode::failed);
  }
  if (!scene.error.empty() && !isNotRun(scene) &&
      scene.errorExitCode != static_cast<int>(base::ExitCode::notComparable))
    scene.errorExitCode = static_cast<int>(base::ExitCode::failed);
  scene.verdict = ownVerdict(scene);
  for (ViewResult& view : scene.views) {
    settleView(scene, view);
    scene.verdict = worse(scene.verdict, view.verdict);
  }
}

compare::Verdict verdictOf(const BaselineSummary& baseline) {
  if (!baseline.error.empty()) return compare::Verdict::error;
  return baseline.gone.empty() ? compare::Verdict::pass : compare::Verdict::warn;
}

} // namespace

void setNotRun(SceneResult& scene, int signal) {
  scene.error = fmt::format("{} interrupted the run before this scene was done", base::signalName(signal));
  scene.errorExitCode = kFirstSignal + signal;
}

int stoppedBy(const SceneResult& scene) {
  return scene.error.empty() ? 0 : std::max(scene.errorExitCode - kFirstSignal, 0);
}

bool isNotRun(const SceneResult& scene) { return stoppedBy(scene) > 0; }

compare::Verdict ownVerdict(const SceneResult& scene) {
  if (scene.error.empty()) return compare::Verdict::pass;
  return isNotRun(scene) ? compare::Verdict::notRun : compare::Verdict::error;
}

std::string findUnsound(const compare::Figures& figures) {
  if (!std::isfinite(figures.referenceLuma) || !std::isfinite(figures.testLuma)) return "luma";
  if (!std::isfinite(figures.referenceLuminance) || !std::isfinite(figures.testLuminance)) return "luminance";
  if (!std::isfinite(figures.clipped())) return "share of clipped pixels";
  const auto unsound = std::ranges::find_if_not(figures.values, isSound);
  return unsound == figures.values.end() ? "" : unsound->name;
}

void settleMaterial(MaterialResult& material, bool seenElsewhere) {
  material.seenElsewhere = false;
  Judgement judgement;
  const bool isSmall = material.figures.pixels > 0;
  if (isSeen(material)) {
    judgement =
        withBaseline(withTruth(judgeSeen(material.figures, material.checks, material.rule, material.notModelled, true),
                               material.truth),
                     material.baseline);
  } else {
    // Another view that shows it is why this one does not count, so that there is nothing to accept.
    judgement = judgeUnseen(seenElsewhere ? compare::AppliedRule{} : material.rule,
                            isSmall ? compare::Accept::tooSmall : compare::Accept::notSeen,
                            isSmall ? describeSize(material) : "no view shows it");
    if (seenElsewhere) {
      material.seenElsewhere = true;
      judgement.add("another view shows it");
    } else if (material.rule.requireSeen) {
      judgement = {compare::Verdict::fail, judgement.reason + ", but its budget requires that it is seen", {}};
    }
  }
  material.verdict = judgement.verdict;
  material.reason = std::move(judgement.reason);
  material.accepted = acceptedOf(judgement, material.rule);
  for (WhatIf& each : material.whatIf) settleWhatIf(material, each);
}

void settleVerdicts(Report& report) {
  report.verdict = report.scenes.empty() ? compare::Verdict::error : compare::Verdict::pass;
  for (SceneResult& scene : report.scenes) {
    settleScene(scene);
    report.verdict = worse(report.verdict, scene.verdict);
  }
  if (report.baseline) report.verdict = worse(report.verdict, verdictOf(*report.baseline));
  if (!report.warnings.empty()) report.verdict = worse(report.verdict, compare::Verdict::warn);
  for (const RunProblem& problem : problemsOf(report)) report.verdict = worse(report.verdict, problem.verdict);
}

int exitCode(const Report& report, bool warnExit, FailOn failOn, const EarlierRuns* earlier) {
  using base::ExitCode;
  int code = 0;
  const auto raise = [&](ExitCode other) { code = std::max(code, static_cast<int>(other)); };
  if (report.scenes.empty()) raise(ExitCode::failed);
  if (report.baseline && verdictOf(*report.baseline) == compare::Verdict::error) raise(ExitCode::failed);
  if (report.baseline && warnExit && verdictOf(*report.baseline) == compare::Verdict::warn)
    raise(ExitCode::warningsOnly);
  if (warnExit && !report.warnings.empty()) raise(ExitCode::warningsOnly);
  for (const RunProblem& problem : problemsOf(report))
    raise(problem.verdict == compare::Verdict::error ? ExitCode::failed : ExitCode::overBudget);
  for (const SceneResult& scene : report.scenes) {
    if (isNotRun(scene))
      code = std::max(code, scene.errorExitCode);
    else if (!scene.error.empty())
      raise(scene.errorExitCode == static_cast<int>(ExitCode::notComparable) ? ExitCode::notComparable
                                                                             : ExitCode::failed);
    // A scene's own verdict is `error` also for its error line, whose code stands above; its views tell the rest.
    if (scene.error.empty() && scene.views.empty()) raise(ExitCode::failed);
    for (const ViewResult& view : scene.views) {
      if (view.verdict == compare::Verdict::error) raise(ExitCode::failed);
      if (view.verdict == compare::Verdict::fail && failOn == FailOn::any) raise(ExitCode::overBudget);
      if (warnExit && view.verdict != compare::Verdict::pass) raise(ExitCode::warningsOnly);
    }
  }
  if (failOn == FailOn::isNew) {
    if (countFailures(report, standingBy(earlier)).isNew > 0) raise(ExitCode::overBudget);
    if (!whyNewIsUnknown(report, earlier).empty()) raise(ExitCode::failed);
  }
  return code;
}

} // namespace parity::report
