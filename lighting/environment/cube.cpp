// The geometry of a cube map in Vulkan's layout.
#include "lighting/environment/cube.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace parity::lighting {

glm::dvec3 directionOf(const FacePoint& p) {
  switch (p.face) {
  case 0:
    return {1, -p.t, -p.s};
  case 1:
    return {-1, -p.t, p.s};
  case 2:
    return {p.s, 1, p.t};
  case 3:
    return {p.s, -1, -p.t};
  case 4:
    return {p.s, -p.t, 1};
  default:
    return {-p.s, -p.t, -1};
  }
}

FacePoint facePointOf(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z) return {d.x > 0 ? 0 : 1, (d.x > 0 ? -d.z : d.z) / a.x, -d.y / a.x};
  if (a.y >= a.z) return {d.y > 0 ? 2 : 3, d.x / a.y, (d.y > 0 ? d.z : -d.z) / a.y};
  return {d.z > 0 ? 4 : 5, (d.z > 0 ? d.x : -d.x) / a.z, -d.y / a.z};
}

std::vector<double> texelSolidAngles(int n) {
  // The face's part between its middle and (s, t) subtends atan(s t / sqrt(s^2 + t^2 + 1)); a texel is the difference
  // of four such corners.
  const auto corner = [n](int x, int y) {
    const double s = 2.0 * x / n - 1, t = 2.0 * y / n - 1;
    return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
  };
  std::vector<double> angles(static_cast<std::size_t>(n) * n), upper(n + 1), lower(n + 1);
  for (int x = 0; x <= n; ++x) upper[x] = corner(x, 0);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x <= n; ++x) lower[x] = corner(x, y + 1);
    for (int x = 0; x < n; ++x)
      angles[static_cast<std::size_t>(y) * n + x] = upper[x] + lower[x + 1] - upper[x + 1] - lower[x];
    std::swap(upper, lower);
  }
  return angles;
}

std::vector<glm::vec4> halveMip(const std::vector<glm::vec4>& mip, int n) {
  assert(n >= 2 && n % 2 == 0 && mip.size() == texelIndex(kCubeFaces, 0, 0, n));
  const int half = n / 2;
  const std::vector<double> angles = texelSolidAngles(n);
  std::vector<glm::vec4> halved(texelIndex(kCubeFaces, 0, 0, half));
  base::parallelFor(static_cast<std::size_t>(kCubeFaces) * half, 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int face = static_cast<int>(row) / half, y = static_cast<int>(row) % half;
      for (int x = 0; x < half; ++x) {
        glm::dvec4 sum{0.0};
        double angle = 0;
        for (const auto [dx, dy] : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          const double weight = angles[static_cast<std::size_t>(2 * y + dy) * n + 2 * x + dx];
          sum += weight * glm::dvec4(mip[texelIndex(face, 2 * x + dx, 2 * y + dy, n)]);
          angle += weight;
        }
        halved[texelIndex(face, x, y, half)] = glm::vec4(sum / angle);
      }
    }
  });
  return halved;
}

} // namespace parity::lighting
