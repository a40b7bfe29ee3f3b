#include "job/view_attribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "compare/attribution.h"
#include "compare/baseline.h"

namespace parity::job {

namespace {

// A part of mobile's picture with a swapped term, as its target makes it: what the swap changes of what the target
// stores is added to the picture that the target did make. Layers are blended and samples averaged in the target's own
// numbers; to store the linear sum alone would undo that, and blame a term for it.
base::Image store(const base::Image& swapped, const compare::Rect& box, const ViewFrames& frames,
                  const gpu::TargetCodec& target) {
  const auto kept = [&](const float* rgb) { return target.read(target.store(target.write({rgb[0], rgb[1], rgb[2]}))); };
  base::Image stored(swapped.width, swapped.height, 3);
  base::parallelFor(static_cast<std::size_t>(box.height), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < box.width; ++x) {
        const float* before = frames.mobileBeforeTarget.at(box.x + x, box.y + y);
        const float* made = frames.mobile.color.at(box.x + x, box.y + y);
        const glm::vec3 keptBefore = kept(before), keptSwapped = kept(swapped.at(x, y));
        for (int c = 0; c < 3; ++c) {
          const bool isAsStored = made[c] == keptBefore[c] || !std::isfinite(made[c]) || !std::isfinite(keptBefore[c]);
          stored.at(x, y)[c] = isAsStored ? keptSwapped[c] : made[c] + (keptSwapped[c] - keptBefore[c]);
        }
      }
  });
  return stored;
}

} // namespace

std::vector<std::size_t> materialsToAttribute(Attribution wanted, const compare::ViewResult& view,
                                              const Judges& judges) {
  std::vector<std::size_t> places;
  if (wanted == Attribution::none) return places;
  compare::Report judged;
  judged.scenes.emplace_back().name = judges.scene;
  const compare::ViewResult& copy = judged.scenes[0].views.emplace_back(view);
  for (compare::MaterialResult& material : judged.scenes[0].views[0].materials)
    compare::judgeMaterial(material, judges.budgets, judges.scene);
  if (judges.baseline) compare::compareWithBaseline(judged, *judges.baseline, {.source = "", .materials = {}});
  for (std::size_t i = 0; i < copy.materials.size(); ++i) {
    const compare::MaterialResult& material = copy.materials[i];
    if (material.figures.all.pixels > 0 && (wanted == Attribution::all || material.verdict >= compare::Verdict::fail))
      places.push_back(i);
  }
  return places;
}

void attributeView(Context& context, const ViewFrames& frames, const std::vector<std::size_t>& materials,
                   float exposureEv, ComparedView& compared) {
  const base::Stopwatch watch(&context.timings(), "attribution");
  const Settings& settings = context.settings();
  std::vector<compare::MaterialResult>& results = compared.view.materials;
  base::parallelFor(results.size(), 1, [&](std::size_t i, std::size_t) {
    if (results[i].terms.empty()) results[i].terms = termFigures(frames, frames.coverage[compared.materials[i]]);
  });
  std::vector<const base::PixelList*> lists;
  for (const std::size_t i : materials) lists.push_back(&frames.coverage[compared.materials[i]]);
  const gpu::TargetCodec target(settings.mobileTarget, exposureEv,
                                mobile::precisionOn(context.deviceReport(), settings.mobile) ==
                                    mobile::Precision::fp16);
  const auto show = [&](const base::Image& linear, const compare::Rect& box) {
    Displayed shown = displayImage(store(linear, box, frames, target), context.display(), exposureEv);
    return compare::ShownPicture{std::move(shown.pixels), std::move(shown.nonFinite)};
  };
  std::vector<std::optional<compare::Attribution>> found = compare::attributeTerms(
      {compared.highend.pixels, compared.mobile.pixels, compared.highend.nonFinite, compared.mobile.nonFinite,
       frames.mobileBeforeTarget, frames.highend.terms, frames.mobile.terms},
      lists, show);
  for (std::size_t i = 0; i < materials.size(); ++i) results[materials[i]].attribution = std::move(found[i]);
}

compare::PassResult attributionPass(Attribution wanted, const compare::SceneResult& result) {
  compare::PassResult pass{"attribution", "terms", 0, ""};
  bool any = false;
  for (const compare::ViewResult& view : result.views) {
    std::set<std::string> swapped;
    for (const compare::MaterialResult& material : view.materials) {
      if (!material.attribution) continue;
      any = true;
      for (const compare::TermEffect& effect : material.attribution->terms) swapped.insert(effect.term);
    }
    pass.count += swapped.size();
  }
  if (pass.count == 0)
    pass.skipped = wanted == Attribution::none ? "not asked for"
                   : any                       ? "no term differs"
                                               : "no material is over budget";
  return pass;
}

} // namespace parity::job
