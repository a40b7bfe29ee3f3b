#include "gpu/surface/other_terms.h"

#include "base/parallel.h"
#include "shading/terms.h"

namespace parity::gpu {

std::vector<const ShadedPlane*> otherTerms(std::span<const ShadedPlane> terms) {
  std::vector<const ShadedPlane*> others;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (!shading::isOfLightsAlone(t) && !terms[t].isBlack()) others.push_back(&terms[t]);
  return others;
}

ShadedPlane withOtherTerms(const ShadedPlane& picture, std::span<const ShadedPlane* const> others) {
  std::vector<glm::vec4> sum(picture.size());
  base::parallelFor(sum.size(), std::size_t{1} << 15, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sum[i] = picture[i];
      for (const ShadedPlane* term : others) sum[i] += glm::vec4(glm::vec3((*term)[i]), 0);
    }
  });
  return sum;
}

} // namespace parity::gpu
