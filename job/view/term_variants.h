// The test path's colours with one of their terms exchanged for the reference path's: what attribution composes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "gpu/surface/material_swap.h"

namespace parity::job {

// Of a surface shaded by both paths with their terms, which must outlive the variants.
class TermVariants {
public:
  // The variant of a term is the test's colour less its term, plus the reference's; where the test's colour is not
  // finite the sum of its other terms, plus the reference's, so that a term that is NaN is found. Nothing is clamped.
  // Only at entries that `swap` swaps; others have no value. terms: the places of those that get a variant.
  TermVariants(const gpu::Surface& surface, const gpu::ShadedSurface& reference, const gpu::ShadedSurface& test,
               std::span<const std::size_t> terms, const gpu::SwapBuilder& swap);

  // The test's colours as they are, then the variants in the order of `terms`; each beside the reference's colours.
  std::vector<gpu::SwapPlane> planes() const;

private:
  const gpu::ShadedSurface &m_reference, &m_test;
  std::vector<base::RawVector<glm::vec4>> m_colors;
};

// Marks the terms that an exchange may change: those that are not 0 everywhere in either path, and all of them where a
// colour of the test is not finite. used: a mark for each term.
void markUsedTerms(const gpu::ShadedSurface& reference, const gpu::ShadedSurface& test, std::vector<char>& used);

// The places that are marked.
std::vector<std::size_t> placesOf(const std::vector<char>& marks);

} // namespace parity::job
