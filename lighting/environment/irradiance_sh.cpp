// Irradiance by spherical harmonics of order 2.
#include "lighting/environment/irradiance_sh.h"

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "shading/shading.h"

namespace parity::lighting {

std::array<glm::vec3, 9> projectIrradiance(const std::vector<glm::vec4>& faces, int n) {
  using Coefficients = std::array<glm::dvec3, 9>;
  constexpr std::size_t kRowsPerPart = 16;
  const std::size_t rows = static_cast<std::size_t>(kCubeFaces) * n;
  const std::vector<double> angles = texelSolidAngles(n);
  std::vector<Coefficients> parts((rows + kRowsPerPart - 1) / kRowsPerPart);
  base::parallelFor(rows, kRowsPerPart, [&](std::size_t begin, std::size_t end) {
    Coefficients sum{};
    for (std::size_t row = begin; row < end; ++row) {
      const int face = static_cast<int>(row / n), y = static_cast<int>(row % n);
      for (int x = 0; x < n; ++x) {
        const glm::dvec3 d = texelDirection(face, x, y, n);
        const shading::f64::ShBasis basis = shading::f64::shBasis({d.x, d.y, d.z});
        const glm::dvec3 energy =
            angles[static_cast<std::size_t>(y) * n + x] * glm::dvec3(faces[texelIndex(face, x, y, n)]);
        for (int i = 0; i < 9; ++i) sum[i] += energy * basis.y[i];
      }
    }
    parts[begin / kRowsPerPart] = sum;
  });
  Coefficients total{};
  for (const Coefficients& part : parts)
    for (int i = 0; i < 9; ++i) total[i] += part[i];
  std::array<glm::vec3, 9> irradiance;
  for (int i = 0; i < 9; ++i) {
    const int band = i == 0 ? 0 : i < 4 ? 1 : 2;
    irradiance[i] = glm::vec3(total[i] * shading::f64::shCosineKernel(band));
  }
  return irradiance;
}

} // namespace parity::lighting
