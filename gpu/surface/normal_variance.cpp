#include "gpu/surface/normal_variance.h"

#include <glm/glm.hpp>

#include "base/parallel.h"
#include "gpu/surface/mip_taps.h"
#include "shading/shading.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kTexelGrain = 65536; // texels

glm::vec3 unitNormal(const std::uint8_t* texel) {
  const glm::vec3 n = glm::vec3(texel[0], texel[1], texel[2]) * (2 / 255.f) - 1.f;
  const float length = glm::length(n);
  return length > 1e-3f ? n / length : glm::vec3(0, 0, 1);
}

// read(x, y): the normal at a texel of the level before.
std::vector<glm::vec3> average(int width, int height, int targetWidth, int targetHeight, const auto& read) {
  const std::vector<Taps> tapsX = makeTaps(width, targetWidth), tapsY = makeTaps(height, targetHeight);
  std::vector<glm::vec3> means(static_cast<std::size_t>(targetWidth) * targetHeight);
  base::parallelFor(targetHeight, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < targetWidth; ++x) {
        glm::dvec3 sum(0); // stored in float: a flat map keeps its length within 1e-6 through all levels
        for (int ky = 0; ky < tapsY[y].count; ++ky)
          for (int kx = 0; kx < tapsX[x].count; ++kx)
            sum += tapsY[y].weights[ky] * tapsX[x].weights[kx] *
                   glm::dvec3(read(tapsX[x].first + kx, tapsY[y].first + ky));
        means[y * targetWidth + x] = sum;
      }
  });
  return means;
}

} // namespace

base::Image8 withoutVariance(base::Image8 image) {
  base::parallelFor(image.pixelCount(), kTexelGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) image.pixels[4 * t + 3] = 0;
  });
  return image;
}

void NormalVariance::writeNext(const base::Image8& finer, base::Image8& mip) {
  const auto meanOf = [&](int x, int y) { return m_means[static_cast<std::size_t>(y) * finer.width + x]; };
  const auto normalOf = [&](int x, int y) { return unitNormal(finer.at(x, y)); };
  m_means = m_means.empty() ? average(finer.width, finer.height, mip.width, mip.height, normalOf)
                            : average(finer.width, finer.height, mip.width, mip.height, meanOf);
  base::parallelFor(mip.pixelCount(), kTexelGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const double length = glm::length(glm::dvec3(m_means[t]));
      mip.pixels[4 * t + 3] =
          static_cast<std::uint8_t>(255 * std::sqrt(shading::f64::alphaSquaredOfNormals(length)) + 0.5);
    }
  });
}

} // namespace parity::gpu
