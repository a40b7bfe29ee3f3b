// Mobile's colours with one of their terms exchanged for the high-end path's: what attribution composes.
#pragma once

#include <array>
#include <vector>

#include "gpu/surface/material_swap.h"
#include "shading/terms.h"

namespace parity::job {

// Of a surface shaded by both paths with their terms, which must outlive the variants.
class TermVariants {
public:
  static constexpr std::size_t kPlanes = 1 + shading::kTermCount;

  // Variant t is mobile's colour less its term t, plus the high-end path's; where mobile's colour is not finite the sum
  // of its other terms, plus the high-end path's, so that a term that is NaN is found. Nothing is clamped.
  TermVariants(const gpu::Surface& surface, const gpu::ShadedSurface& highend, const gpu::ShadedSurface& mobile);

  // kPlanes of them: mobile's colours as they are, then the variants; the reference is the high-end path's colours.
  std::vector<gpu::SwapPlane> planes() const;

private:
  const gpu::ShadedSurface &m_highend, &m_mobile;
  std::array<std::vector<glm::vec4>, shading::kTermCount> m_colors;
};

} // namespace parity::job
