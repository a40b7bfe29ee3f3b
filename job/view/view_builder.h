// Puts the frames of one view together from its shaded layers, for all paths at the same time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/surface/coverage_builder.h"
#include "gpu/surface/frame_builder.h"
#include "job/scene/prepared_scene.h"
#include "job/scene/reference_path.h"
#include "job/view/view_frames.h"

namespace parity::job {

// A surface by one path.
struct ShadedByPath {
  gpu::ShadedSurface shaded;
  std::optional<gpu::ShadedSurface> ofOriginals; // with its textures as they are, where it compresses them
};

class ViewBuilder {
public:
  struct PathPlan {
    std::optional<gpu::TargetCodec> target; // that its colour is stored in
    bool ofOriginals = false;               // it is shaded twice, its textures compressed and as they are
    bool isWhatIf = false;                  // ViewFrames::whatIfs
  };
  // plans: of each path, then of each of the settings' what-ifs.
  ViewBuilder(const Settings& settings, const std::vector<PathPlan>& plans, bool truth,
              const gpu::SceneBuffers& buffers);

  // One (tile, sample), its layers from the back to the front, each by every path; tiles in order of rows, all samples
  // of one before the next. layers: how many will be laid, at most.
  void begin(const gpu::Tile& tile, std::size_t layers);
  // paths: one for each plan. truth: null where there is none.
  void lay(const gpu::Surface& surface, const std::vector<ShadedByPath>& paths, const ReferenceSurface* truth);
  void end();

  // Empty afterwards.
  ViewFrames take();
  // Points of the truth that were not in closed form.
  std::uint64_t sampledPoints() const { return m_sampledPoints; }

private:
  struct PathBuilders {
    std::optional<gpu::FrameBuilder> frame, beforeTarget, ofOriginals;
    std::optional<gpu::SwapBuilder> swap, swapLight, truthSwap, truthTermSwap, termVariants;
    std::vector<std::size_t> variantTerms; // as of PathFrames
    bool isWhatIf = false;
  };
  template <typename Do> void forEachFrame(const Do& act);
  template <typename Do> void forEachSwap(const Do& act);
  void layCoverage(const gpu::Surface& surface, const std::vector<ShadedByPath>& paths, const ReferenceSurface* truth);

  std::vector<PathBuilders> m_paths;
  std::optional<gpu::FrameBuilder> m_truth;
  std::optional<ErrorBuilder> m_error;
  std::optional<gpu::CoverageBuilder> m_coverage;
  std::uint64_t m_sampledPoints = 0, m_lightSamples = 0;
};

} // namespace parity::job
