#include "job/view/view_attribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "compare/metrics/attribution.h"
#include "job/view/material_swaps.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "shading/terms.h"

namespace parity::job {

namespace {

// A material's swapped picture by one of the first path's terms, as the other's target makes it where that has made the
// whole pixel: what the term changes of what the target stores is added to what the target did store. Layers are
// blended and samples averaged in the target's own numbers; to store the linear sum alone would undo that, and blame a
// term for it.
gpu::SwappedPixels storeVariant(const gpu::SwappedPixels& swapped, const gpu::SwappedPixels& variants,
                                std::size_t plane, const std::optional<gpu::TargetCodec>& target) {
  const auto kept = [&](const float* rgb) {
    const glm::vec3 color(rgb[0], rgb[1], rgb[2]);
    return target ? target->read(target->store(target->write(color))) : color;
  };
  const base::Image &made = swapped.planes[0], &plain = variants.planes[0], &variant = variants.planes[plane];
  gpu::SwappedPixels stored;
  base::Image& out = stored.planes.emplace_back(made);
  base::parallelFor(made.pixelCount(), 16384, [&](std::size_t begin, std::size_t end) {
    auto whole = std::ranges::lower_bound(swapped.whole, static_cast<std::uint32_t>(begin)); // sorted
    for (std::size_t i = begin; i < end; ++i) {
      const bool isWhole = whole != swapped.whole.end() && *whole == i;
      if (isWhole) ++whole;
      const float *before = &plain.pixels[3 * i], *after = &variant.pixels[3 * i], *as = &made.pixels[3 * i];
      const glm::vec3 keptBefore = isWhole ? kept(before) : glm::vec3(before[0], before[1], before[2]),
                      keptAfter = isWhole ? kept(after) : glm::vec3(after[0], after[1], after[2]);
      for (int c = 0; c < 3; ++c) {
        const bool isAsStored = as[c] == keptBefore[c] || !std::isfinite(as[c]) || !std::isfinite(keptBefore[c]);
        out.pixels[3 * i + static_cast<std::size_t>(c)] =
            isAsStored ? keptAfter[c] : as[c] + (keptAfter[c] - keptBefore[c]);
      }
    }
  });
  return stored;
}

bool areSame(const base::Image& a, const base::Image& b) {
  return std::ranges::equal(a.pixels, b.pixels,
                            [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

compare::AttributionInput inputOf(Context& context, const ViewFrames& frames, std::size_t material,
                                  const std::optional<gpu::TargetCodec>& target, float exposureEv,
                                  const ComparedView& compared) {
  const base::PixelList& list = frames.coverage[material];
  const PathFrames& path = frames.paths[compared.test];
  const gpu::SwappedPixels &swapped = path.swap[material], &variants = path.termVariants[material];
  compare::AttributionInput input{displaySwap(context, list, swapped, 0, exposureEv, &compared.tested), {}};
  for (std::size_t i = 0; i < path.variantTerms.size(); ++i) {
    if (areSame(variants.planes[0], variants.planes[1 + i])) continue;
    input.terms.push_back(
        {std::string(shading::kTermNames[path.variantTerms[i]]),
         displaySwap(context, list, storeVariant(swapped, variants, 1 + i, target), 0, exposureEv, nullptr)});
    input.terms.back().swap.linear = {};
  }
  input.swap.linear = {};
  return input;
}

} // namespace

std::vector<std::size_t> materialsToAttribute(Attribution wanted, const report::ViewResult& view,
                                              const Judges& judges) {
  std::vector<std::size_t> places;
  if (wanted == Attribution::none) return places;
  report::Report judged;
  judged.device = judges.device;
  judged.conditions = reported(judges.conditions.run);
  judged.scenes.emplace_back().name = judges.scene;
  judged.scenes[0].conditions = reported(judges.conditions.scene);
  const report::ViewResult& copy = judged.scenes[0].views.emplace_back(view);
  for (report::MaterialResult& material : judged.scenes[0].views[0].materials)
    report::judgeMaterial(material, judges.budgets, judges.scene);
  if (judges.baseline) report::compareWithBaseline(judged, *judges.baseline, {.source = "", .materials = {}});
  for (std::size_t i = 0; i < copy.materials.size(); ++i) {
    const report::MaterialResult& material = copy.materials[i];
    if (material.figures.pixels > 0 && (wanted == Attribution::all || material.verdict >= compare::Verdict::fail))
      places.push_back(i);
  }
  return places;
}

void attributeView(Context& context, const ViewFrames& frames, const std::vector<std::size_t>& materials,
                   const Settings& settings, const paths::Path& path, ComparedView& compared) {
  const base::Stopwatch watch(&context.timings(), "attribution");
  const float exposureEv = settings.exposureEv;
  std::vector<report::MaterialResult>& results = compared.view.materials;
  base::parallelFor(results.size(), 1, [&](std::size_t i, std::size_t) {
    if (results[i].terms.empty())
      results[i].terms = termFigures(frames, compared.test, frames.coverage[compared.materials[i]]);
  });
  const std::optional<gpu::TargetCodec> target = path.target(settings.options, context.deviceReport(), exposureEv);
  // One material's pictures at a time: each may have as many as there are terms.
  for (const std::size_t i : materials) {
    const compare::AttributionInput input =
        inputOf(context, frames, compared.materials[i], target, exposureEv, compared);
    results[i].attribution =
        compare::attributeTerms({compared.reference.pixels, nullptr, compared.reference.nonFinite}, {&input, 1})
            .front();
  }
}

report::PassResult attributionPass(Attribution wanted, const report::SceneResult& result) {
  report::PassResult pass{"attribution", "terms", 0, ""};
  bool any = false;
  for (const report::ViewResult& view : result.views) {
    std::set<std::string> swapped;
    for (const report::MaterialResult& material : view.materials) {
      if (!material.attribution) continue;
      any = true;
      for (const compare::TermEffect& effect : material.attribution->terms) swapped.insert(effect.term);
    }
    pass.count += swapped.size();
  }
  if (pass.count == 0)
    pass.skipped = wanted == Attribution::none ? "not requested"
                   : any                       ? "no term differs"
                                               : "no material is over budget";
  return pass;
}

} // namespace parity::job
