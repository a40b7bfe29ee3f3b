// Frames from shaded surfaces: layers laid over one another, tiles put together, samples averaged.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "gpu/surface/output_target.h"
#include "gpu/surface/shading_pass.h"

namespace parity::gpu {

// Gathers one path's picture. background: linear RGB, where no material is seen.
class FrameBuilder {
public:
  // target: what the colour is stored in, sample by sample, layer over layer, and once more when samples become a
  // pixel; none: nothing is rounded. Terms are never. terms: of each (SceneBuffers::termCount()) whether it is
  // composed; the images of others stay empty. An empty list: the frame has no terms.
  FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, const std::vector<char>& terms,
               const glm::vec3& background, const std::optional<TargetCodec>& target = std::nullopt);
  // Of terms alone, which no target rounds: the frame's colour stays empty.
  static FrameBuilder ofTerms(std::uint32_t width, std::uint32_t height, int samples, const std::vector<char>& terms);

  // One (tile, sample): begins with the background; then its layers from the back to the front, those of surfaces that
  // are not blended first. The surfaces' pixels lie within the tile.
  void begin(const Tile& tile);
  void lay(const Surface& surface, const ShadedSurface& shaded);
  void end();
  // The mean over the samples, taken in the target's own numbers. The builder is empty afterwards.
  base::Frame take();

private:
  FrameBuilder(std::uint32_t width, int samples, const glm::vec3& background, const std::optional<TargetCodec>& target);
  // The colour (0) or one of the terms.
  base::Image& imageOf(std::size_t plane) { return plane == 0 ? m_frame.color : m_frame.terms[plane - 1]; }
  std::size_t planeCount() const { return 1 + m_frame.terms.size(); }
  bool isComposed(std::size_t plane) { return !imageOf(plane).empty(); }
  // Where the tile's plane begins.
  float* planeAt(std::size_t plane);

  std::uint32_t m_width;
  int m_samples;
  glm::vec3 m_background;
  std::optional<TargetCodec> m_target;
  base::Frame m_frame; // the sum over samples
  Tile m_tile;
  // Of the tile: colour, then the terms. Empty where there is one sample, which is composed in the frame.
  std::vector<std::vector<float>> m_sample;
};

} // namespace parity::gpu
