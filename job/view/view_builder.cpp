#include "job/view/view_builder.h"

#include <array>

#include "job/view/term_variants.h"

namespace parity::job {

ViewBuilder::ViewBuilder(const Settings& settings, const std::vector<PathPlan>& plans, bool truth,
                         const gpu::SceneBuffers& buffers)
    : m_paths(plans.size()) {
  const auto makeFrame = [&](bool terms, const std::optional<gpu::TargetCodec>& codec) {
    return gpu::FrameBuilder(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height),
                             settings.samples, std::vector<char>(terms ? buffers.termCount() : 0, 1),
                             settings.background, codec);
  };
  const auto makeSwap = [&](std::optional<gpu::SwapBuilder>& swap, std::size_t planes, const glm::vec3& background,
                            const std::optional<gpu::TargetCodec>& codec) {
    swap.emplace(buffers.materialOfInstance(), buffers.scene().materials.size(),
                 static_cast<std::uint32_t>(settings.width), settings.samples,
                 std::vector<glm::vec3>(planes, background), codec);
  };
  const bool compares = plans.size() > 1;
  const auto makeWhatIf = [&](PathBuilders& path, const std::optional<gpu::TargetCodec>& target) {
    path.isWhatIf = true;
    path.frame = makeFrame(false, target);
    makeSwap(path.swap, 1, settings.background, target);
    if (!target || !target->isDisplayed()) return;
    path.beforeTarget = makeFrame(false, std::nullopt);
    makeSwap(path.swapLight, 1, settings.background, std::nullopt);
  };
  for (std::size_t i = 0; i < plans.size(); ++i) {
    PathBuilders& path = m_paths[i];
    const auto& [target, ofOriginals, isWhatIf] = plans[i];
    if (isWhatIf) {
      makeWhatIf(path, target);
      continue;
    }
    path.frame = makeFrame(settings.terms, target);
    if (compares && truth) makeSwap(path.truthSwap, 1, settings.background, target);
    if (compares && truth && settings.terms)
      makeSwap(path.truthTermSwap, buffers.termCount(), glm::vec3(0), std::nullopt);
    if (i == 0) continue;
    path.beforeTarget = makeFrame(false, std::nullopt);
    if (ofOriginals) path.ofOriginals = makeFrame(false, target);
    makeSwap(path.swap, 1, settings.background, target);
    if (target && target->isDisplayed()) makeSwap(path.swapLight, 1, settings.background, std::nullopt);
    if (settings.terms && settings.attribution != Attribution::none) {
      path.variantTerms = placesOf(std::vector<char>(buffers.termCount(), 1));
      makeSwap(path.termVariants, 1 + buffers.termCount(), settings.background, std::nullopt);
    }
  }
  if (truth) {
    m_truth = makeFrame(settings.terms, std::nullopt);
    m_error.emplace(settings.width, settings.height, settings.samples);
  }
  if (compares || settings.coverage) m_coverage.emplace(buffers, settings.samples);
}

template <typename Do> void ViewBuilder::forEachSwap(const Do& act) {
  for (PathBuilders& path : m_paths)
    for (std::optional<gpu::SwapBuilder>* swap :
         {&path.swap, &path.swapLight, &path.truthSwap, &path.truthTermSwap, &path.termVariants})
      if (*swap) act(**swap);
}

template <typename Do> void ViewBuilder::forEachFrame(const Do& act) {
  for (PathBuilders& path : m_paths)
    for (std::optional<gpu::FrameBuilder>* frame : {&path.frame, &path.beforeTarget, &path.ofOriginals})
      if (*frame) act(**frame);
  if (m_truth) act(*m_truth);
}

void ViewBuilder::begin(const gpu::Tile& tile, std::size_t layers) {
  forEachFrame([&](gpu::FrameBuilder& frame) { frame.begin(tile); });
  forEachSwap([&](gpu::SwapBuilder& swap) { swap.begin(tile, layers); });
  if (m_error) m_error->begin(tile);
  if (m_coverage) m_coverage->begin(tile);
}

void ViewBuilder::lay(const gpu::Surface& surface, const std::vector<ShadedByPath>& paths,
                      const ReferenceSurface* truth) {
  const auto laySwap = [&](std::optional<gpu::SwapBuilder>& swap, const gpu::ShadedSurface& from,
                           const gpu::ShadedSurface& to) {
    if (swap) swap->lay(surface, from, to, std::array{gpu::SwapPlane{from.color, to.color}});
  };
  for (std::size_t i = 0; i < paths.size(); ++i) {
    PathBuilders& builders = m_paths[i];
    const auto& [shaded, ofOriginals] = paths[i];
    builders.frame->lay(surface, shaded);
    if (builders.beforeTarget) builders.beforeTarget->lay(surface, shaded);
    if (ofOriginals) builders.ofOriginals->lay(surface, *ofOriginals);
    const gpu::ShadedSurface& first = paths.front().shaded;
    laySwap(builders.swap, first, shaded);
    laySwap(builders.swapLight, first, shaded);
    if (builders.termVariants)
      builders.termVariants->lay(
          surface, first, shaded,
          TermVariants(surface, first, shaded, builders.variantTerms, *builders.termVariants).planes());
    if (!truth || builders.isWhatIf) continue;
    laySwap(builders.truthSwap, truth->shaded, shaded);
    if (!builders.truthTermSwap) continue;
    std::vector<gpu::SwapPlane> planes;
    for (std::size_t t = 0; t < shaded.terms.size(); ++t) planes.push_back({truth->shaded.terms[t], shaded.terms[t]});
    builders.truthTermSwap->lay(surface, truth->shaded, shaded, planes);
  }
  if (truth) {
    m_truth->lay(surface, truth->shaded);
    m_error->lay(surface, *truth);
    m_sampledPoints += truth->sampledPoints;
    m_lightSamples += truth->lightSamples;
  }
  if (m_coverage) layCoverage(surface, paths, truth);
}

// The opacity is the same in every path: it comes from the shared material, unless a path's is compressed.
void ViewBuilder::layCoverage(const gpu::Surface& surface, const std::vector<ShadedByPath>& paths,
                              const ReferenceSurface* truth) {
  std::size_t count = paths.size(); // without the what-ifs, which have no originals
  while (count > 0 && m_paths[count - 1].isWhatIf) --count;
  if (count == 0)
    m_coverage->lay(surface, truth->shaded);
  else if (paths[count - 1].ofOriginals)
    m_coverage->lay(surface, *paths[count - 1].ofOriginals);
  else
    m_coverage->lay(surface, paths[count - 1].shaded);
}

void ViewBuilder::end() {
  forEachFrame([](gpu::FrameBuilder& frame) { frame.end(); });
  forEachSwap([](gpu::SwapBuilder& swap) { swap.end(); });
  if (m_error) m_error->end();
  if (m_coverage) m_coverage->end();
}

ViewFrames ViewBuilder::take() {
  ViewFrames frames;
  if (m_truth) {
    frames.truth = m_truth->take();
    frames.truthError = m_error->take(frames.truth.color);
    frames.truthTaken = m_error->samples();
    frames.truthSamples =
        m_sampledPoints > 0 ? static_cast<double>(m_lightSamples) / static_cast<double>(m_sampledPoints) : 0;
  }
  if (m_coverage) frames.coverage = m_coverage->take();
  const auto take = [&](std::optional<gpu::SwapBuilder>& swap, const base::Image* finished) {
    if (!swap) return std::vector<gpu::SwappedPixels>();
    return finished ? swap->take(frames.coverage, std::array{finished}) : swap->take(frames.coverage, {});
  };
  for (PathBuilders& builders : m_paths) {
    PathFrames& path = (builders.isWhatIf ? frames.whatIfs : frames.paths).emplace_back();
    path.frame = builders.frame->take();
    if (builders.beforeTarget) path.beforeTarget = builders.beforeTarget->take().color;
    if (builders.ofOriginals) path.ofOriginals = builders.ofOriginals->take().color;
    path.swap = take(builders.swap, &path.frame.color);
    path.swapLight = take(builders.swapLight, &path.beforeTarget);
    path.truthSwap = take(builders.truthSwap, &path.frame.color);
    path.truthTermSwap = take(builders.truthTermSwap, nullptr);
    path.termVariants = take(builders.termVariants, nullptr);
    path.variantTerms = std::move(builders.variantTerms);
  }
  return frames;
}

} // namespace parity::job
