// A panorama checked, clamped and brought to a width that suits a cube.
#include "lighting/environment/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/image/image.h"
#include "base/parallel.h"
#include "scenes/environment.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;

glm::vec3 texelAt(const base::Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return glm::min(glm::vec3(p[0], p[1], p[2]), scenes::kMaxRadiance);
}

// The largest divisor of `size` that leaves at least `least`.
int divisorLeaving(int size, int least) {
  for (int divisor = std::max(1, size / least); divisor > 1; --divisor)
    if (size % divisor == 0) return divisor;
  return 1;
}

} // namespace

void checkRadiance(const scenes::Environment& environment) {
  const base::Image& image = environment.radiance;
  const auto fail = [&](const std::string& reason) {
    throw base::fileError("environment " + environment.name, "", reason);
  };
  if (image.empty() || image.width < 1 || image.height < 1) fail("has no pixels");
  if (image.channels != 3) fail("has " + std::to_string(image.channels) + " channels instead of 3");
  if (image.pixels.size() != image.pixelCount() * 3) fail("has a size that does not match its pixels");
  for (const float value : image.pixels)
    if (!(value >= 0 && std::isfinite(value))) fail("holds a radiance that is negative or not finite");
  if (!std::isfinite(environment.rotationDeg)) fail("has a rotation that is not finite");
}

glm::vec3 interpolateRadiance(const base::Image& image, double x, double y) {
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const float fx = static_cast<float>(x - 0.5 - left), fy = static_cast<float>(y - 0.5 - top);
  const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
  const int y0 = std::clamp(static_cast<int>(top), 0, image.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, image.height - 1);
  const glm::vec3 upper = glm::mix(texelAt(image, x0, y0), texelAt(image, x1, y0), fx);
  const glm::vec3 lower = glm::mix(texelAt(image, x0, y1), texelAt(image, x1, y1), fx);
  return glm::mix(upper, lower, fy);
}

double panoramaAzimuth(double a, float rotationDeg) {
  // A turn by +r about +Y takes azimuth a to a - r, so what is seen at a stood at a + r.
  return a + static_cast<double>(rotationDeg) * pi / 180;
}

Panorama makePanorama(const scenes::Environment& environment, int faceSize) {
  checkRadiance(environment);
  const base::Image& image = environment.radiance;
  const int growX = (4 * faceSize + image.width - 1) / image.width;
  const int growY = (2 * faceSize + image.height - 1) / image.height;
  const bool grows = growX > 1 || growY > 1;
  const int shrinkX = grows ? 1 : divisorLeaving(image.width, 8 * faceSize);
  const int shrinkY = grows ? 1 : divisorLeaving(image.height, 4 * faceSize);
  Panorama p;
  p.width = image.width * growX / shrinkX;
  p.height = image.height * growY / shrinkY;
  p.rotationDeg = environment.rotationDeg;
  p.rowY.resize(static_cast<std::size_t>(p.height) + 1);
  for (int y = 0; y <= p.height; ++y) p.rowY[y] = std::cos(pi * y / p.height);
  p.columns.resize(static_cast<std::size_t>(p.width) * p.height);
  base::parallelFor(p.width, 16, [&](std::size_t begin, std::size_t end) {
    for (int y = 0; y < p.height; ++y)
      for (std::size_t x = begin; x < end; ++x) {
        glm::vec3& texel = p.columns[x * p.height + y];
        if (grows) {
          texel = interpolateRadiance(image, (x + 0.5) / growX, (y + 0.5) / growY);
          continue;
        }
        glm::dvec3 sum{0.0};
        double area = 0;
        for (int sy = y * shrinkY; sy < (y + 1) * shrinkY; ++sy) {
          const double height = std::cos(pi * sy / image.height) - std::cos(pi * (sy + 1) / image.height);
          for (int sx = 0; sx < shrinkX; ++sx)
            sum += height * glm::dvec3(texelAt(image, static_cast<int>(x) * shrinkX + sx, sy));
          area += height * shrinkX;
        }
        texel = glm::vec3(sum / area);
      }
  });
  return p;
}

} // namespace parity::lighting
