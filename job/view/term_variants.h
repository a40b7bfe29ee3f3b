// The test path's colours with one of their terms exchanged for the reference path's: what attribution composes.
#pragma once

#include <vector>

#include "base/raw_vector.h"
#include "gpu/surface/material_swap.h"

namespace parity::job {

// Of a surface shaded by both paths with their terms, which must outlive the variants.
class TermVariants {
public:
  // Variant t is the test's colour less its term t, plus the reference's; where the test's colour is not finite the sum
  // of its other terms, plus the reference's, so that a term that is NaN is found. Nothing is clamped. Only at entries
  // that `swap` swaps; others have no value.
  TermVariants(const gpu::Surface& surface, const gpu::ShadedSurface& reference, const gpu::ShadedSurface& test,
               const gpu::SwapBuilder& swap);

  // The test's colours as they are, then the variants, one for each term; each beside the reference's colours.
  std::vector<gpu::SwapPlane> planes() const;

private:
  const gpu::ShadedSurface &m_reference, &m_test;
  std::vector<base::RawVector<glm::vec4>> m_colors;
};

} // namespace parity::job
