// Frames and pixel lists from shaded surfaces: tiles put together, samples averaged, the blended layer laid on top.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "gpu/output_target.h"
#include "gpu/shading_pass.h"

namespace parity::gpu {

// Gathers one path's picture. background: linear RGB, where no material is seen.
class FrameBuilder {
public:
  // target: what the colour is stored in, sample by sample, layer over layer, and once more when samples become a
  // pixel; none: nothing is rounded. Terms are never.
  FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, bool terms, const glm::vec3& background,
               const std::optional<TargetCodec>& target = std::nullopt);

  // One (tile, sample): the opaque surface with its shading, then the blended one where the scene has any (else both
  // null). The surfaces' pixels lie within the tile.
  void add(const Surface& opaque, const ShadedSurface& opaqueShaded, const Surface* blended,
           const ShadedSurface* blendedShaded, const Tile& tile);
  // The mean over the samples, taken in the target's own numbers. The builder is empty afterwards.
  base::Frame take();

private:
  int m_samples;
  glm::vec3 m_background;
  std::optional<TargetCodec> m_target;
  base::Frame m_frame;          // the sum over samples
  std::vector<float> m_scratch; // one sample of one tile
};

// Gathers which pixels show which material, with weights: the share of samples, times the opacity of a blended layer,
// times what it lets through of the surface behind it.
class CoverageBuilder {
public:
  CoverageBuilder(const SceneBuffers& scene, int samples);

  // One (tile, sample). Tiles in order of rows, all samples of one before the next.
  void add(const Surface& opaque, const Surface* blended, const ShadedSurface* blendedShaded, const Tile& tile);
  // One list per material, in the scene's order; a material that no pixel shows has an empty one. Weights are left out
  // where all are 1.
  std::vector<base::PixelList> take();

private:
  struct Hit {
    std::uint32_t pixel, material;
    float weight; // over samples
  };
  std::vector<Hit> hitsOf(const Surface& opaque, const Surface* blended, const ShadedSurface* blendedShaded,
                          const Tile& tile) const;
  void finishTile();

  const SceneBuffers& m_scene;
  int m_samples, m_samplesOfTile = 0;
  std::vector<Hit> m_tile; // ascending by pixel, then material; a pair once
  std::vector<base::PixelList> m_lists;
};

} // namespace parity::gpu
