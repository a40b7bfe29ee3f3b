// The brightest texels of a cube, summed one by one.
#include "lighting/environment/bright_texels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/environment/cube.h"
#include "scenes/luminance.h"

namespace parity::lighting {

namespace {

constexpr double kLimitOverMean = 20;

double luminanceOf(const glm::vec4& c) { return scenes::luminanceOf(glm::dvec3(c)); }

// integral NoL / t^2 dl over the hemisphere, where t = u + a^2 (1 - u), u = (1 - NoL) / 2 and a = alpha: D is a^2 / pi
// times 1 / t^2, and so in both of numerator and denominator.
double integrateLobe(double alpha) {
  const double a2 = alpha * alpha, b = 1 - a2;
  if (b < 1e-6) return std::numbers::pi;
  const double v = (1 + a2) / 2; // t at the horizon
  return 4 * std::numbers::pi / b * ((1 + 2 * a2 / b) * (1 / a2 - 1 / v) - 2 / b * std::log(v / a2));
}

} // namespace

BrightTexels takeBrightTexels(std::vector<glm::vec4>& faces, int n) {
  const std::vector<double> angles = texelSolidAngles(n);
  double mean = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    mean += luminanceOf(faces[i]) * angles[i % angles.size()] / (4 * std::numbers::pi);
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (luminanceOf(faces[i]) > kLimitOverMean * mean) bright.push_back(i);
  double limit = kLimitOverMean * mean;
  if (bright.size() > kMaxBrightTexels) {
    const auto first = bright.begin() + kMaxBrightTexels;
    std::nth_element(bright.begin(), first, bright.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(-luminanceOf(faces[a]), a) < std::pair(-luminanceOf(faces[b]), b);
    });
    limit = luminanceOf(faces[*first]);
    bright.erase(first, bright.end());
    std::sort(bright.begin(), bright.end()); // the order of the sum
  }

  BrightTexels texels;
  texels.fours.resize((bright.size() + 3) / 4);
  for (std::size_t k = 0; k < bright.size(); ++k) {
    glm::vec4& texel = faces[bright[k]];
    const int index = static_cast<int>(bright[k]), face = index / (n * n), y = index / n % n, x = index % n;
    const glm::dvec3 direction = texelDirection(face, x, y, n);
    const double kept = limit / luminanceOf(texel);
    BrightTexels::Four& four = texels.fours[k / 4];
    for (int c = 0; c < 3; ++c) {
      four.direction[c][k % 4] = static_cast<float>(direction[c]);
      four.energy[c][k % 4] = static_cast<float>(texel[c] * (1 - kept) * angles[bright[k] % angles.size()]);
      texel[c] = static_cast<float>(texel[c] * kept);
    }
  }
  return texels;
}

glm::vec3 sumBrightTexels(const BrightTexels& texels, const glm::vec3& normal, double roughness) {
  const double alpha = roughness * roughness;
  const auto a2 = static_cast<float>(alpha * alpha);
  std::array<Float4, 3> sums{};
  for (const BrightTexels::Four& four : texels.fours) {
    const Float4 dx = four.direction[0] - normal.x, dy = four.direction[1] - normal.y,
                 dz = four.direction[2] - normal.z;
    const Float4 u = (dx * dx + dy * dy + dz * dz) * 0.25f; // (1 - NoL) / 2 without its cancellation
    const Float4 NoL = 1 - 2 * u, t = u + a2 * (1 - u);
    const Float4 weight = (NoL > 0 ? NoL : Float4{}) / (t * t);
    for (int c = 0; c < 3; ++c) sums[c] += weight * four.energy[c];
  }
  const double scale = 1 / integrateLobe(alpha);
  glm::vec3 result;
  for (int c = 0; c < 3; ++c)
    result[c] = static_cast<float>(scale * (double{sums[c][0]} + sums[c][1] + sums[c][2] + sums[c][3]));
  return result;
}

} // namespace parity::lighting
