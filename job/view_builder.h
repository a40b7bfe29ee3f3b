// Puts the frames of one view together from its shaded layers, for all paths at the same time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/frame.h"
#include "gpu/coverage_builder.h"
#include "gpu/frame_builder.h"
#include "gpu/material_swap.h"
#include "job/prepared_scene.h"
#include "job/reference_path.h"

namespace parity::job {

struct ViewFrames {
  base::Frame highend, mobile, reference; // empty where not asked for
  base::Image referenceError;             // relative standard error of each pixel (job/reference_path.h)
  base::Image referenceTaken;             // samples of each pixel, of the environment, for each way of sampling
  double referenceSamples = 0;            // taken of the environment, a point and way of sampling
  std::vector<base::PixelList> coverage;  // a list per material; of highend and mobile together, or with settings.coverage
  base::Image mobileBeforeTarget;         // mobile's colour as if nothing were stored; for both paths together
  base::Image mobileOfOriginals;          // with the textures as they are; empty where mobile has them, too
  // The material swap, one for each coverage list: the first path's picture in which the material alone carries the
  // second one's colours. With the truth its colours, and its terms as planes in the order of shading::Term.
  std::vector<gpu::SwappedPixels> highendMobile;
  std::vector<gpu::SwappedPixels> highendMobileLight; // before the target, where that is displayed: nothing is cut off
  std::vector<gpu::SwappedPixels> truthHighend, truthMobile, truthHighendTerms, truthMobileTerms;
  // highendMobile as it was computed, before the target, then by each of the high-end path's terms (TermVariants); of
  // the materials that are attributed.
  std::vector<gpu::SwappedPixels> termVariants;
};

class ViewBuilder {
public:
  // target: that mobile's colour is stored in; none: of an intermediate, which is looked at as it was computed.
  // ofOriginals: mobile is laid twice, its textures compressed and as they are.
  ViewBuilder(const Settings& settings, const Paths& paths, const gpu::SceneBuffers& buffers,
              const std::optional<gpu::TargetCodec>& target, bool ofOriginals);

  // One (tile, sample), its layers from the back to the front, each by every path; tiles in order of rows, all samples
  // of one before the next.
  void begin(const gpu::Tile& tile);
  void layHighend(const gpu::Surface& surface, const gpu::ShadedSurface& shaded);
  void layMobile(const gpu::Surface& surface, const gpu::ShadedSurface& shaded);
  void layMobileOfOriginals(const gpu::Surface& surface, const gpu::ShadedSurface& shaded);
  void layReference(const gpu::Surface& surface, const ReferenceSurface& shaded);
  // What the paths' surfaces make together; reference: null where there is none.
  void laySwaps(const gpu::Surface& surface, const gpu::ShadedSurface& highend, const gpu::ShadedSurface& mobile,
                const gpu::ShadedSurface* reference);
  void end();

  // Empty afterwards.
  ViewFrames take();
  // Points of the reference that were not in closed form.
  std::uint64_t sampledPoints() const { return m_sampledPoints; }

private:
  template <typename Do> void forEachFrame(const Do& act);
  template <typename Do> void forEachSwap(const Do& act);

  std::optional<gpu::SwapBuilder> m_swap, m_swapLight, m_truthHighend, m_truthMobile, m_truthHighendTerms,
      m_truthMobileTerms, m_variants;
  std::optional<gpu::FrameBuilder> m_highend, m_mobile, m_reference, m_beforeTarget, m_ofOriginals;
  std::optional<ErrorBuilder> m_error;
  std::optional<gpu::CoverageBuilder> m_coverage; // masks are for comparing
  std::uint64_t m_sampledPoints = 0, m_lightSamples = 0;
};

} // namespace parity::job
