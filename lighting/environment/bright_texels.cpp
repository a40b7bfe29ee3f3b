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

} // namespace parity::lighting
