// How many rows of a report have each verdict, are accepted, or have a truth.
#include <algorithm>

#include "report/report.h"

namespace parity::report {
namespace {

void count(VerdictCounts& counts, compare::Verdict verdict) {
  switch (verdict) {
  case compare::Verdict::pass:
    ++counts.pass;
    break;
  case compare::Verdict::notSeen:
    ++counts.notSeen;
    break;
  case compare::Verdict::tooSmall:
    ++counts.tooSmall;
    break;
  case compare::Verdict::notJudged:
    ++counts.notJudged;
    break;
  case compare::Verdict::warn:
    ++counts.warn;
    break;
  case compare::Verdict::fail:
    ++counts.fail;
    break;
  case compare::Verdict::error:
    ++counts.error;
    break;
  }
}

} // namespace

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

AcceptedCounts countAccepted(const Report& report) {
  AcceptedCounts counts;
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      counts.wholes += view.wholeVerdict == compare::Verdict::pass && !view.accepted.empty();
      for (const MaterialResult& material : view.materials)
        counts.materials += material.verdict == compare::Verdict::pass && !material.accepted.empty();
    }
  return counts;
}

bool hasTruth(const Report& report) {
  return std::ranges::any_of(report.scenes, [](const SceneResult& scene) {
    return std::ranges::any_of(scene.views, [](const ViewResult& view) { return view.truth.has_value(); });
  });
}

} // namespace parity::report
