#include "job/kept_pictures.h"

#include <algorithm>
#include <set>
#include <string>

#include "report/baseline.h"

namespace parity::job {

namespace {

// As the whole run will be settled: what settles a row is in its own scene, and in the baseline.
std::vector<compare::Verdict> verdictsOf(const ComparedScene& scene, const report::Report* baseline,
                                         const RunFacts& facts) {
  report::Report alone;
  alone.device = facts.device;
  alone.conditions = facts.conditions;
  alone.scenes = {scene.result};
  report::settleVerdicts(alone);
  if (baseline) report::compareWithBaseline(alone, *baseline, {.source = {}, .materials = {}, .sameScenesOnly = true});
  std::vector<compare::Verdict> verdicts;
  for (const report::ViewResult& view : alone.scenes.front().views) verdicts.push_back(view.verdict);
  return verdicts;
}

// Clears the names, and puts them among those of the files that are dropped.
void drop(std::set<std::string>& dropped, std::initializer_list<std::string*> names) {
  for (std::string* name : names) {
    if (!name->empty()) dropped.insert(*name);
    name->clear();
  }
}

void dropOf(std::set<std::string>& dropped, report::ImageSet& images, std::optional<compare::Truth>& truth) {
  drop(dropped, {&images.reference, &images.test, &images.flip});
  if (truth) drop(dropped, {&truth->images.truth, &truth->images.referenceFlip, &truth->images.testFlip});
}

} // namespace

void dropPictures(ComparedScene& scene, Pictures wanted, const report::Report* baseline, const RunFacts& facts) {
  if (wanted != Pictures::notPassed || scene.pictures.empty()) return;
  const std::vector<compare::Verdict> verdicts = verdictsOf(scene, baseline, facts);
  std::set<std::string> dropped;
  for (std::size_t v = 0; v < verdicts.size(); ++v) {
    if (verdicts[v] >= compare::Verdict::warn) continue;
    report::ViewResult& view = scene.result.views[v];
    dropOf(dropped, view.images, view.truth);
    drop(dropped, {&view.pixels.color, &view.pixels.terms});
    for (report::MaterialResult& material : view.materials) dropOf(dropped, material.crops, material.truth);
  }
  if (scene.result.error.empty() && std::ranges::all_of(verdicts, [](auto v) { return v < compare::Verdict::warn; }))
    for (report::MaterialCard& card : scene.result.materials)
      for (report::CardInput& input : card.inputs)
        if (input.texture) drop(dropped, {&input.texture->picture});
  std::erase_if(scene.pictures, [&](const EncodedPicture& picture) { return dropped.contains(picture.file); });
}

} // namespace parity::job
