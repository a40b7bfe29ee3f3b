// Which pixels show which material, and how much of it: from the surfaces of all layers.
#pragma once

#include <vector>

#include "base/frame.h"
#include "gpu/surface/shading_pass.h"

namespace parity::gpu {

// A pixel counts for a material by its contribution: the share of samples, times the opacity of the layers that show
// it, times what the layers in front of those let through. The weights of a pixel add up to 1 where something opaque
// is seen behind all, to less where the background is.
class CoverageBuilder {
public:
  CoverageBuilder(const SceneBuffers& scene, int samples);

  // One (tile, sample), as gpu::FrameBuilder takes it; tiles in order of rows, all samples of one before the next.
  // shaded: by any path, for the opacities.
  void begin(const Tile& tile);
  void lay(const Surface& surface, const ShadedSurface& shaded);
  void end();
  // One list per material, in the scene's order; a material that no pixel shows has an empty one. Weights are left out
  // where all are 1.
  std::vector<base::PixelList> take();

private:
  struct Hit {
    std::uint32_t pixel, material;
    float weight; // over samples
  };
  std::vector<Hit> hitsOfSample() const;
  void finishTile();

  const SceneBuffers& m_scene;
  int m_samples, m_samplesOfTile = 0;
  Tile m_tile;
  std::uint32_t m_width = 0;
  std::vector<std::vector<Hit>> m_layers; // of the sample, from the back to the front; weight: opacity
  std::vector<Hit> m_sum;                 // of the tile: ascending by pixel, then material; a pair once
  std::vector<base::PixelList> m_lists;
};

} // namespace parity::gpu
