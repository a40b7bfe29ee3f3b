#include "job/view_builder.h"

#include <array>

#include "job/term_variants.h"

namespace parity::job {

ViewBuilder::ViewBuilder(const Settings& settings, const Paths& paths, const gpu::SceneBuffers& buffers,
                         const std::optional<gpu::TargetCodec>& target, bool ofOriginals) {
  const auto makeFrame = [&](bool terms, const std::optional<gpu::TargetCodec>& codec) {
    return gpu::FrameBuilder(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height),
                             settings.samples, terms, settings.background, codec);
  };
  if (paths.highend) m_highend = makeFrame(settings.terms, std::nullopt);
  if (paths.mobile) m_mobile = makeFrame(settings.terms, target);
  if (ofOriginals) m_ofOriginals = makeFrame(false, target);
  if (paths.reference) {
    m_reference = makeFrame(settings.terms, std::nullopt);
    m_error.emplace(settings.width, settings.height, settings.samples);
  }
  if (paths.highend && paths.mobile) m_beforeTarget = makeFrame(false, std::nullopt);
  if ((paths.highend && paths.mobile) || settings.coverage)
    m_coverage.emplace(buffers, settings.samples);
  if (!paths.highend || !paths.mobile) return;
  const auto makeSwap = [&](std::optional<gpu::SwapBuilder>& swap, std::size_t planes, const glm::vec3& background,
                            const std::optional<gpu::TargetCodec>& codec) {
    swap.emplace(buffers.materialOfInstance(), buffers.scene().materials.size(),
                 static_cast<std::uint32_t>(settings.width), settings.samples,
                 std::vector<glm::vec3>(planes, background), codec);
  };
  makeSwap(m_swap, 1, settings.background, target);
  if (target && target->isDisplayed()) makeSwap(m_swapLight, 1, settings.background, std::nullopt);
  if (settings.terms && settings.attribution != Attribution::none)
    makeSwap(m_variants, TermVariants::kPlanes, settings.background, std::nullopt);
  if (!paths.reference) return;
  makeSwap(m_truthHighend, 1, settings.background, std::nullopt);
  makeSwap(m_truthMobile, 1, settings.background, target);
  if (!settings.terms) return;
  makeSwap(m_truthHighendTerms, shading::kTermCount, glm::vec3(0), std::nullopt);
  makeSwap(m_truthMobileTerms, shading::kTermCount, glm::vec3(0), std::nullopt);
}

template <typename Do> void ViewBuilder::forEachSwap(const Do& act) {
  for (std::optional<gpu::SwapBuilder>* swap :
       {&m_swap, &m_swapLight, &m_truthHighend, &m_truthMobile, &m_truthHighendTerms, &m_truthMobileTerms, &m_variants})
    if (*swap) act(**swap);
}

template <typename Do> void ViewBuilder::forEachFrame(const Do& act) {
  for (std::optional<gpu::FrameBuilder>* frame : {&m_highend, &m_mobile, &m_reference, &m_beforeTarget, &m_ofOriginals})
    if (*frame) act(**frame);
}

void ViewBuilder::begin(const gpu::Tile& tile) {
  forEachFrame([&](gpu::FrameBuilder& frame) { frame.begin(tile); });
  forEachSwap([&](gpu::SwapBuilder& swap) { swap.begin(tile); });
  if (m_error) m_error->begin(tile);
  if (m_coverage) m_coverage->begin(tile);
}

void ViewBuilder::layHighend(const gpu::Surface& surface, const gpu::ShadedSurface& shaded) {
  m_highend->lay(surface, shaded);
  // The opacity is the same in every path: it comes from the shared material.
  if (m_coverage && !m_mobile) m_coverage->lay(surface, shaded);
}

void ViewBuilder::layMobile(const gpu::Surface& surface, const gpu::ShadedSurface& shaded) {
  m_mobile->lay(surface, shaded);
  if (m_beforeTarget) m_beforeTarget->lay(surface, shaded);
  // The opacity is the same in every path: it comes from the shared material, unless mobile's is compressed.
  if (m_coverage && !m_ofOriginals) m_coverage->lay(surface, shaded);
}

void ViewBuilder::layMobileOfOriginals(const gpu::Surface& surface, const gpu::ShadedSurface& shaded) {
  m_ofOriginals->lay(surface, shaded);
  if (m_coverage) m_coverage->lay(surface, shaded);
}

void ViewBuilder::layReference(const gpu::Surface& surface, const ReferenceSurface& shaded) {
  m_reference->lay(surface, shaded.shaded);
  m_error->lay(surface, shaded);
  if (m_coverage && !m_highend && !m_mobile) m_coverage->lay(surface, shaded.shaded);
  m_sampledPoints += shaded.sampledPoints;
  m_lightSamples += shaded.lightSamples;
}

void ViewBuilder::laySwaps(const gpu::Surface& surface, const gpu::ShadedSurface& highend,
                           const gpu::ShadedSurface& mobile, const gpu::ShadedSurface* reference) {
  const auto layColors = [&](std::optional<gpu::SwapBuilder>& swap, const gpu::ShadedSurface& from,
                             const gpu::ShadedSurface& to) {
    if (swap) swap->lay(surface, from, to, std::array{gpu::SwapPlane{from.color, to.color}});
  };
  const auto layTerms = [&](std::optional<gpu::SwapBuilder>& swap, const gpu::ShadedSurface& to) {
    if (!swap) return;
    std::vector<gpu::SwapPlane> planes;
    for (std::size_t t = 0; t < shading::kTermCount; ++t) planes.push_back({reference->terms[t], to.terms[t]});
    swap->lay(surface, *reference, to, planes);
  };
  layColors(m_swap, highend, mobile);
  layColors(m_swapLight, highend, mobile);
  if (m_variants) m_variants->lay(surface, highend, mobile, TermVariants(surface, highend, mobile).planes());
  if (!reference) return;
  layColors(m_truthHighend, *reference, highend);
  layColors(m_truthMobile, *reference, mobile);
  layTerms(m_truthHighendTerms, highend);
  layTerms(m_truthMobileTerms, mobile);
}

void ViewBuilder::end() {
  forEachFrame([](gpu::FrameBuilder& frame) { frame.end(); });
  forEachSwap([](gpu::SwapBuilder& swap) { swap.end(); });
  if (m_error) m_error->end();
  if (m_coverage) m_coverage->end();
}

ViewFrames ViewBuilder::take() {
  ViewFrames frames;
  if (m_highend) frames.highend = m_highend->take();
  if (m_mobile) frames.mobile = m_mobile->take();
  if (m_reference) {
    frames.reference = m_reference->take();
    frames.referenceError = m_error->take(frames.reference.color);
    frames.referenceTaken = m_error->samples();
    frames.referenceSamples =
        m_sampledPoints > 0 ? static_cast<double>(m_lightSamples) / static_cast<double>(m_sampledPoints) : 0;
  }
  if (m_coverage) frames.coverage = m_coverage->take();
  if (m_beforeTarget) frames.mobileBeforeTarget = m_beforeTarget->take().color;
  if (m_ofOriginals) frames.mobileOfOriginals = m_ofOriginals->take().color;
  const auto take = [&](std::optional<gpu::SwapBuilder>& swap, const base::Image* finished) {
    if (!swap) return std::vector<gpu::SwappedPixels>();
    return finished ? swap->take(frames.coverage, std::array{finished}) : swap->take(frames.coverage, {});
  };
  frames.highendMobile = take(m_swap, &frames.mobile.color);
  frames.highendMobileLight = take(m_swapLight, &frames.mobileBeforeTarget);
  frames.truthHighend = take(m_truthHighend, &frames.highend.color);
  frames.truthMobile = take(m_truthMobile, &frames.mobile.color);
  frames.truthHighendTerms = take(m_truthHighendTerms, nullptr);
  frames.truthMobileTerms = take(m_truthMobileTerms, nullptr);
  frames.termVariants = take(m_variants, nullptr);
  return frames;
}

} // namespace parity::job
