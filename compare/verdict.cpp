// From checks to verdicts: of a material, a view, a scene, the report; and the exit code.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "compare/report.h"
#include "compare/statistic.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

Verdict worse(Verdict a, Verdict b) { return std::max(a, b); }

// Infinite may only be what is better the more of it there is: psnr of identical images.
bool isSound(const Figure& figure) {
  if (std::isfinite(figure.value)) return true;
  const std::optional<Statistic> statistic = statisticByName(figure.name);
  return figure.value == INFINITY && statistic && statistic->better == Better::higher;
}

// The name of a figure that is no number; empty if there is none.
std::string findUnsound(const Figures& figures) {
  if (!std::isfinite(figures.referenceLuma) || !std::isfinite(figures.testLuma)) return "luma";
  const auto unsound = std::ranges::find_if_not(figures.values, isSound);
  return unsound == figures.values.end() ? "" : unsound->name;
}

struct Judgement {
  Verdict verdict = Verdict::pass;
  std::string reason;
};

// The worst of the checks that could be judged; of all where none could. Null where there are none.
const CheckResult* findWorst(const std::vector<CheckResult>& checks) {
  const bool anyJudged = std::ranges::any_of(checks, &CheckResult::judged);
  const CheckResult* worst = nullptr;
  for (const CheckResult& check : checks)
    if ((check.judged() || !anyJudged) && (!worst || check.verdict > worst->verdict)) worst = &check;
  return worst;
}

// What holds for a material and for a whole image alike, once there is a pixel.
Judgement judgeSeen(const RegionFigures& figures, const std::vector<CheckResult>& checks) {
  if (figures.all.nonFinite > 0)
    return {Verdict::fail, fmt::format("{} of {} pixels are NaN or infinite in one of the two renders",
                                       figures.all.nonFinite, figures.all.pixels)};
  std::string unsound = findUnsound(figures.all);
  if (unsound.empty() && figures.interior.pixels > 0) unsound = findUnsound(figures.interior);
  if (!unsound.empty()) return {Verdict::error, fmt::format("a figure is not a number: {}", unsound)};
  if (figures.all.values.empty()) return {Verdict::error, "no figure was measured"};

  const CheckResult* worst = findWorst(checks);
  if (!worst) return {Verdict::error, "no budget check applies"};
  if (!worst->judged()) return {worst->verdict, "its budget holds regressions only: " + describeCheck(*worst)};
  if (worst->verdict == Verdict::pass) return {};
  const auto equals = std::ranges::count_if(
      checks, [&](const CheckResult& check) { return check.judged() && check.verdict == worst->verdict; });
  return {worst->verdict, describeCheck(*worst) + (equals > 1 ? fmt::format(" (and {} more)", equals - 1) : "")};
}

// A truth that is no number measured nothing: an error, whatever was judged besides.
Judgement withTruth(Judgement judgement, const std::optional<Truth>& truth) {
  if (!truth || truth->all.nonFinite == 0) return judgement;
  std::string reason =
      fmt::format("{} of {} pixels of the truth are NaN or infinite", truth->all.nonFinite, truth->all.highend.pixels);
  if (!judgement.reason.empty()) reason += "; " + judgement.reason;
  return {worse(judgement.verdict, Verdict::error), std::move(reason)};
}

// The name of another view of the scene that shows the material; empty if there is none.
std::string findOtherView(const SceneResult& scene, const ViewResult& here, std::size_t index) {
  for (const ViewResult& view : scene.views)
    if (&view != &here && index < view.materials.size() && view.materials[index].name == here.materials[index].name &&
        view.materials[index].figures.all.pixels > 0)
      return view.name;
  return {};
}

void settleWhole(ViewResult& view) {
  Judgement judgement;
  if (view.materials.empty())
    judgement = {Verdict::error, "the view holds no material to compare"};
  else if (view.whole.all.pixels == 0)
    judgement = {Verdict::notSeen, "no pixel of this view shows any material"};
  else
    judgement = withTruth(judgeSeen(view.whole, view.checks), view.truth);
  view.wholeVerdict = judgement.verdict;
  view.reason = std::move(judgement.reason);
}

void settleView(const SceneResult& scene, ViewResult& view) {
  settleWhole(view);
  view.verdict = view.wholeVerdict;
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    MaterialResult& material = view.materials[i];
    const std::string other = findOtherView(scene, view, i);
    settleMaterial(material, !other.empty());
    if (material.seenElsewhere) material.reason = fmt::format("not seen in this view; view '{}' shows it", other);
    if (!material.seenElsewhere) view.verdict = worse(view.verdict, material.verdict);
  }
}

void settleScene(SceneResult& scene) {
  if (scene.error.empty() && scene.views.empty()) {
    scene.error = "no view was compared";
    scene.errorExitCode = static_cast<int>(base::ExitCode::failed);
  }
  if (!scene.error.empty() && scene.errorExitCode != static_cast<int>(base::ExitCode::notComparable))
    scene.errorExitCode = static_cast<int>(base::ExitCode::failed);
  scene.verdict = scene.error.empty() ? Verdict::pass : Verdict::error;
  for (ViewResult& view : scene.views) {
    settleView(scene, view);
    scene.verdict = worse(scene.verdict, view.verdict);
  }
}

void count(VerdictCounts& counts, Verdict verdict) {
  switch (verdict) {
  case Verdict::pass:
    ++counts.pass;
    break;
  case Verdict::notSeen:
    ++counts.notSeen;
    break;
  case Verdict::warn:
    ++counts.warn;
    break;
  case Verdict::fail:
    ++counts.fail;
    break;
  case Verdict::error:
    ++counts.error;
    break;
  }
}

Verdict verdictOf(const BaselineSummary& baseline) {
  if (!baseline.error.empty()) return Verdict::error;
  return baseline.gone.empty() ? Verdict::pass : Verdict::warn;
}

} // namespace

const char* nameOf(Verdict verdict) {
  switch (verdict) {
  case Verdict::pass:
    return "pass";
  case Verdict::notSeen:
    return "not seen";
  case Verdict::warn:
    return "warn";
  case Verdict::fail:
    return "fail";
  case Verdict::error:
    return "error";
  }
  return "error";
}

VerdictCounts countVerdicts(const Report& report) {
  VerdictCounts counts;
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      for (const MaterialResult& material : view.materials)
        if (!material.seenElsewhere) count(counts, material.verdict);
  return counts;
}

VerdictCounts countWholes(const Report& report) {
  VerdictCounts counts;
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) count(counts, view.wholeVerdict);
  return counts;
}

bool hasTruth(const Report& report) {
  return std::ranges::any_of(report.scenes, [](const SceneResult& scene) {
    return std::ranges::any_of(scene.views, [](const ViewResult& view) { return view.truth.has_value(); });
  });
}

void settleMaterial(MaterialResult& material, bool seenElsewhere) {
  material.seenElsewhere = false;
  Judgement judgement;
  if (material.figures.all.pixels > 0) {
    judgement = withTruth(judgeSeen(material.figures, material.checks), material.truth);
  } else if (seenElsewhere) {
    material.seenElsewhere = true;
    judgement = {Verdict::notSeen, "not seen in this view; another view shows it"};
  } else if (material.rule.requireSeen) {
    judgement = {Verdict::fail, "no view shows it, and its budget requires that it is seen"};
  } else {
    judgement = {Verdict::notSeen, "no view shows it"};
  }
  material.verdict = judgement.verdict;
  material.reason = std::move(judgement.reason);
}

void settleVerdicts(Report& report) {
  report.verdict = report.scenes.empty() ? Verdict::error : Verdict::pass;
  for (SceneResult& scene : report.scenes) {
    settleScene(scene);
    report.verdict = worse(report.verdict, scene.verdict);
  }
  if (report.baseline) report.verdict = worse(report.verdict, verdictOf(*report.baseline));
}

int exitCode(const Report& report, bool warnExit) {
  using base::ExitCode;
  ExitCode code = ExitCode::withinBudget;
  const auto raise = [&](ExitCode other) { code = std::max(code, other); };
  if (report.scenes.empty()) raise(ExitCode::failed);
  if (report.baseline && verdictOf(*report.baseline) == Verdict::error) raise(ExitCode::failed);
  if (report.baseline && warnExit && verdictOf(*report.baseline) == Verdict::warn) raise(ExitCode::warningsOnly);
  for (const SceneResult& scene : report.scenes) {
    if (!scene.error.empty())
      raise(scene.errorExitCode == static_cast<int>(ExitCode::notComparable) ? ExitCode::notComparable
                                                                             : ExitCode::failed);
    // A scene's own verdict is `error` also for its error line, whose code stands above; its views tell the rest.
    if (scene.error.empty() && scene.views.empty()) raise(ExitCode::failed);
    for (const ViewResult& view : scene.views) {
      if (view.verdict == Verdict::error) raise(ExitCode::failed);
      if (view.verdict == Verdict::fail) raise(ExitCode::overBudget);
      if (warnExit && view.verdict != Verdict::pass) raise(ExitCode::warningsOnly);
    }
  }
  return static_cast<int>(code);
}

} // namespace parity::compare
