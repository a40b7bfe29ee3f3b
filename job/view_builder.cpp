#include "job/view_builder.h"

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
  if ((paths.highend && paths.mobile) || (settings.coverage && (paths.highend || paths.mobile)))
    m_coverage.emplace(buffers, settings.samples);
}

template <typename Do> void ViewBuilder::forEachFrame(const Do& act) {
  for (std::optional<gpu::FrameBuilder>* frame : {&m_highend, &m_mobile, &m_reference, &m_beforeTarget, &m_ofOriginals})
    if (*frame) act(**frame);
}

void ViewBuilder::begin(const gpu::Tile& tile) {
  forEachFrame([&](gpu::FrameBuilder& frame) { frame.begin(tile); });
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
  m_sampledPoints += shaded.sampledPoints;
  m_lightSamples += shaded.lightSamples;
}

void ViewBuilder::end() {
  forEachFrame([](gpu::FrameBuilder& frame) { frame.end(); });
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
  return frames;
}

} // namespace parity::job
