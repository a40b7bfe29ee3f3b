#include "study/explain/report_explanation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "base/text/error_words.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/paths.h"
#include "job/result_cache.h"
#include "job/run_budgets.h"
#include "job/scene/scene_record.h"
#include "job/scene/view_rows.h"
#include "job/stopped.h"
#include "study/explain/explain.h"
#include "study/explain/judged_by.h"

namespace parity::explain {

namespace {

// A material that exceeds no limit warns of parts that are not modelled, or of clipping, and its reason says so.
bool isToBeExplained(const report::MaterialResult& material) {
  const auto isOver = [](compare::Verdict verdict) {
    return verdict == compare::Verdict::warn || verdict == compare::Verdict::fail;
  };
  return isOver(material.verdict) && std::ranges::any_of(material.checks, isOver, &compare::CheckResult::verdict) &&
         !material.isExternal && !material.seenElsewhere && material.figures.pixels > 0 &&
         material.figures.nonFinite == 0;
}

// Of the row's two paths and its view alone.
job::SceneRequest requestOf(const job::SceneRequest& scene, const report::ViewResult& row, std::size_t view) {
  job::SceneRequest request = scene;
  request.views = {scene.views[view]};
  request.settings.pathNames = {row.reference, row.test};
  request.settings.truth = false;
  return request;
}

std::string wordsOf(const report::Explanation& e) {
  std::string words;
  if (!e.approximations.empty() && e.approximations.front().share >= kLeastEffect)
    words = fmt::format("approximation: {}, {:.3f} of FLIP {:.3f}", e.approximations.front().approximation,
                        e.approximations.front().share, e.sets.front().flip);
  if (!e.advice.empty()) words += (words.empty() ? "" : "; ") + e.advice.front();
  while (words.ends_with('.')) words.pop_back();
  return words;
}

// What explains a view, as the cache keeps it: a view whose materials have nothing but names and explanations, and the
// pictures that these name, which are those of no report yet.
job::SceneRecord recordOf(const SceneExplanation& found) {
  job::SceneRecord record;
  record.prefixes = {""};
  record.result.error = found.failure;
  std::vector<report::MaterialResult>& materials = record.result.views.emplace_back().materials;
  for (const MaterialExplanation& m : found.materials) {
    report::MaterialResult& material = materials.emplace_back();
    material.name = m.name;
    report::Explanation& explanation = material.explanation.emplace(explanationOf(m, found.switches));
    const auto add = [&](const base::Image8& image, const char* kind) {
      std::string file = fmt::format("{}_{}", materials.size(), kind);
      record.pictures.push_back({file, base::encodeImage8(file + ".png", image)});
      return file;
    };
    const Illustration& made = m.illustration;
    if (!made.advised.empty()) explanation.picture = add(made.advised, "advised");
    if (!made.mask.empty()) explanation.masks.push_back({made.input, add(made.mask, "mask"), made.texels});
  }
  return record;
}

// By all that decides it: nothing where results are not kept.
std::optional<std::string> keyOf(job::Context& context, const job::SceneRequest& request, const ExplainWish& wish,
                                 const compare::Budgets& budgets) {
  job::ResultWish result;
  result.pictures = wish.illustrates;
  const std::optional<std::string> key =
      job::resultKey(context, job::conditionsOf(context.settings(), request, context.deviceReport()), result);
  if (!key) return std::nullopt;
  base::Hasher hasher;
  assert(wish.switches.empty());
  hasher.add(*key).add("explained");
  for (const std::string& name : wish.materials) {
    const JudgedBy by = judgedBy(budgets, request.name, name);
    hasher.add(name).addValue(by.limit).addValue(by.leastPixels);
  }
  return hasher.hex();
}

job::SceneRecord explain(job::Context& context, const job::SceneRequest& request, const ExplainWish& wish,
                         const compare::Budgets& budgets, const job::Progress& progress) {
  try {
    const std::optional<std::string> key = keyOf(context, request, wish, budgets);
    if (key)
      if (std::optional<job::SceneRecord> kept = job::findResult(context.cache(), *key, request))
        return std::move(*kept);
    const SceneExplanation found = explainScene(context, request, wish, budgets, progress);
    job::SceneRecord record = recordOf(found);
    if (key) job::storeResult(context.cache(), *key, request, found.sources, record);
    return record;
  } catch (const std::exception& error) {
    SceneExplanation failed;
    failed.failure = base::wordsOf(error);
    return recordOf(failed);
  }
}

// Gives a picture its name in the report. One that cannot be written is left out.
void nameAndKeep(const std::vector<job::EncodedPicture>& pictures, std::string& file, const report::MaterialResult& of,
                 const char* kind, const job::KeepPicture& keep) {
  const auto picture = std::ranges::find(pictures, file, &job::EncodedPicture::file);
  assert(picture != pictures.end());
  file = job::pictureBeside(of.crops.test, of.test, kind);
  try {
    keep({file, picture->bytes});
  } catch (const std::exception& error) {
    base::logWarning(base::wordsOf(error));
    file.clear();
  }
}

// The report may be of other files than there are now: it was made by workers, and is merged later or elsewhere.
bool isOfTheReport(const report::Explanation& explanation, const report::MaterialResult& material) {
  const std::optional<double> flip = material.figures.find("flip.mean");
  return !flip || std::abs(explanation.sets.front().flip - *flip) <= kLeastEffect;
}

void explainView(job::Context& context, const job::SceneRequest& request, const compare::Budgets& budgets,
                 report::ViewResult& row, const job::KeepPicture& keep, const job::Progress& progress) {
  ExplainWish wish;
  wish.illustrates = static_cast<bool>(keep);
  for (const report::MaterialResult& material : row.materials)
    if (isToBeExplained(material)) wish.materials.push_back(material.name);
  job::SceneRecord record = explain(context, request, wish, budgets, progress);
  const std::string& failure = record.result.error;
  if (!failure.empty())
    base::logWarning(fmt::format("{}, view {}: not explained: {}", request.name, row.name, failure));
  std::vector<report::MaterialResult>& found = record.result.views.front().materials;
  for (report::MaterialResult& material : row.materials) {
    if (!isToBeExplained(material)) continue;
    const auto of = std::ranges::find(found, material.name, &report::MaterialResult::name);
    report::Explanation& explanation = material.explanation.emplace();
    if (of == found.end()) {
      explanation.failure = failure.empty() ? "not seen, or too small" : failure;
      continue;
    }
    explanation = std::move(*of->explanation);
    if (!isOfTheReport(explanation, material)) {
      explanation = {};
      explanation.failure = "the scene's files, or the device, are not those of the report's figures";
      continue;
    }
    if (!keep || material.crops.test.empty()) { // of a view whose pictures are not kept
      explanation.picture.clear();
      explanation.masks.clear();
      continue;
    }
    if (!explanation.picture.empty()) nameAndKeep(record.pictures, explanation.picture, material, "advised", keep);
    for (report::ErrorMask& mask : explanation.masks)
      nameAndKeep(record.pictures, mask.picture, material, "mask", keep);
    std::erase_if(explanation.masks, [](const report::ErrorMask& mask) { return mask.picture.empty(); });
  }
}

// Of a view whose explanation was interrupted, or not begun.
void setInterrupted(report::ViewResult& row) {
  for (report::MaterialResult& material : row.materials)
    if (isToBeExplained(material) && !material.explanation) {
      material.explanation.emplace();
      material.explanation->failure = "the run was interrupted";
    }
}

} // namespace

report::Explanation explanationOf(const MaterialExplanation& m, const std::vector<Switch>& switches) {
  report::Explanation e;
  if (m.flip.front() > m.limit)
    e.advice = m.advice;
  else
    e.advice = {fmt::format("Its mean FLIP {:.3f} is within {:g}; advice is by mean FLIP.", m.flip.front(), m.limit)};
  for (std::size_t i = 0; i < m.worth.size(); ++i)
    e.approximations.push_back(
        {switches[i].approximation, switches[i].id(), m.flip.front() - m.alone[i].flip, m.worth[i]});
  std::ranges::stable_sort(e.approximations, std::greater(), &report::ApproximationEffect::share);
  for (const SetOutcome& set : m.best) {
    report::ExplainedSet& added = e.sets.emplace_back();
    for (std::size_t i = 0; i < switches.size(); ++i)
      if ((set.mask >> i & 1) != 0) added.changes.push_back(switches[i].id());
    added.flip = set.rendered.value_or(set.flip);
    added.operations = set.cost.operations;
    added.fetches = set.cost.fetches;
  }
  const auto advised = std::ranges::find(m.best, m.repair, &SetOutcome::mask);
  e.advised = advised == m.best.end() ? 0 : static_cast<std::size_t>(advised - m.best.begin());
  for (const RangeShare& r : m.ranges) e.ranges.push_back({r.quantity, r.from, r.to, r.pixels, r.error});
  e.words = wordsOf(e);
  return e;
}

void explainReport(job::Context& context, const job::ReportRequest& request, const job::RunBudgets& budgets,
                   report::Report& report, const job::KeepPicture& keep, const job::Progress& progress) {
  for (report::SceneResult& scene : report.scenes) {
    const auto asked = std::ranges::find(request.scenes, scene.name, &job::SceneRequest::name);
    if (asked == request.scenes.end()) continue;
    std::vector<std::size_t> viewOfRow;
    job::forEachView(*asked, [&](const job::ViewOfPath& row) { viewOfRow.push_back(row.view); });
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
      report::ViewResult& row = scene.views[i];
      if (std::ranges::none_of(row.materials, isToBeExplained)) continue;
      if (job::pathByName(row.test).changes().empty()) continue;
      try {
        context.requireGoesOn();
        explainView(context, requestOf(*asked, row, viewOfRow[i]), budgets.of(*asked), row, keep, progress);
      } catch (const job::Stopped&) {
        setInterrupted(row);
      }
    }
  }
}

} // namespace parity::explain
