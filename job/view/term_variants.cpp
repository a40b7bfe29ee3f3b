#include "job/view/term_variants.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "base/parallel.h"

namespace parity::job {

namespace {

constexpr std::size_t kGrainSamples = 16384;

} // namespace

TermVariants::TermVariants(const gpu::Surface& surface, const gpu::ShadedSurface& reference,
                           const gpu::ShadedSurface& test, std::span<const std::size_t> terms,
                           const gpu::SwapBuilder& swap)
    : m_reference(reference), m_test(test), m_colors(terms.size()) {
  for (base::RawVector<glm::vec4>& colors : m_colors) colors.resize(surface.size());
  base::parallelFor(surface.size(), kGrainSamples, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!swap.swaps(surface, i)) continue;
      // The reference's term as the test would have it: times the opacity where the test's are.
      const bool multiplied = surface.blended && test.premultiplied && !reference.premultiplied;
      const double opacity = multiplied ? reference.color[i].w : 1;
      for (std::size_t place = 0; place < terms.size(); ++place) {
        const std::size_t t = terms[place];
        glm::vec4& out = m_colors[place][i];
        out.w = test.color[i].w;
        for (int c = 0; c < 3; ++c) {
          const double color = test.color[i][c], other = opacity * reference.terms[t][i][c];
          double sum = other;
          if (std::isfinite(color)) { // in double: a term may be all of the colour
            sum = color - test.terms[t][i][c] + other;
          } else {
            for (std::size_t k = 0; k < test.terms.size(); ++k)
              if (k != t) sum += test.terms[k][i][c];
          }
          out[c] = static_cast<float>(sum);
        }
      }
    }
  });
}

std::vector<gpu::SwapPlane> TermVariants::planes() const {
  std::vector<gpu::SwapPlane> planes = {{m_reference.color, m_test.color}};
  for (const base::RawVector<glm::vec4>& colors : m_colors)
    planes.push_back({m_reference.color, gpu::PlaneView(colors)});
  return planes;
}

void markUsedTerms(const gpu::ShadedSurface& reference, const gpu::ShadedSurface& test, std::vector<char>& used) {
  const auto isFinite = [&](std::size_t i) {
    const glm::vec4& c = test.color[i];
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
  };
  if (!std::ranges::all_of(std::views::iota(std::size_t{0}, test.color.size()), isFinite)) std::ranges::fill(used, 1);
  base::parallelFor(used.size(), 1, [&](std::size_t t, std::size_t) {
    if (used[t] == 0) used[t] = reference.terms[t].isBlack() && test.terms[t].isBlack() ? 0 : 1;
  });
}

std::vector<std::size_t> placesOf(const std::vector<char>& marks) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) places.push_back(i);
  return places;
}

} // namespace parity::job
