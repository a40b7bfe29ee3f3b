// GGX prefiltering of a cube map for N = V = R.
#include "lighting/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <cstdlib>

#include "base/parallel.h"
#include "shading/shading.h"

namespace parity::lighting {

namespace {

// Van der Corput's sequence in base 2: the bits of i mirrored behind the point.
double radicalInverse(std::uint32_t i) {
  double result = 0;
  for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) result += (i & 1) * digit;
  return result;
}
double kBias = getenv("BIAS") ? atof(getenv("BIAS")) : 0;
int kMode = getenv("MODE") ? atoi(getenv("MODE")) : 0;

// Any two directions that make a right-handed frame with n (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited", listing 3).
struct Frame {
  glm::vec3 tangent, bitangent;
};
Frame makeFrame(const glm::vec3& n) {
  const float sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

} // namespace

std::vector<LobeSample> makeLobeSamples(double roughness, int count, int faceSize, int levelCount) {
  const double alpha = roughness * roughness, a2 = alpha * alpha;
  std::vector<LobeSample> samples(count);
  const double texelAngle = 4 * std::numbers::pi / (6.0 * faceSize * faceSize);
  double sum = 0;
  // density of c = NoH^2 is D NoL (up to a factor): (2c-1)/(1-(1-a2)c)^2
  const double k = 1 - a2;
  auto F = [&](double c) { // antiderivative
    if (k < 1e-9) return c * c - c;
    const double q = 1 - k * c;
    return (2 / k - 1) / (k * q) + 2 / (k * k) * std::log(q);
  };
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count, phi = 2 * std::numbers::pi * radicalInverse(i);
    double c, w, pdf;
    if (kMode == 0) {
      const double xi = u / (1 + a2);
      c = (1 - xi) / (1 - (1 - a2) * xi);
      w = 2 * c - 1;
      const double D = shading::f64::D_GGX(alpha, std::sqrt(c));
      pdf = D / 4 * (1 + a2);
    } else {
      double lo = 0.5, hi = 1;
      const double target = F(1) + u * (F(.5) - F(1));
      for (int it = 0; it < 60; ++it) {
        const double m = .5 * (lo + hi);
        ((F(m) > target) ? hi : lo) = m;
      }
      c = .5 * (lo + hi);
      w = 1;
      const double norm = 2 * std::numbers::pi * (F(1) - F(.5)); // int D' NoL 2 dc dphi
      const double q = 1 - k * c;
      pdf = (2 * c - 1) / (q * q) / (2 * norm);
    }
    const double NoL = 2 * c - 1, sinL = std::sqrt(std::max(0., 1 - NoL * NoL));
    samples[i].direction = glm::vec3(sinL * std::cos(phi), sinL * std::sin(phi), NoL);
    const double lod = .5 * std::log2(1 / (count * pdf) / (4.0/faceSize/faceSize)) + kBias;
    samples[i].blend=lod;
    samples[i].weight = static_cast<float>(w);
    sum += samples[i].weight;
  }
  for (LobeSample& sample : samples) sample.weight = static_cast<float>(sample.weight / sum);
  return samples;
}

std::vector<glm::vec4> prefilterMip(const CubeSampler& cube, const std::vector<LobeSample>& samples, int size) {
  std::vector<glm::vec4> mip(texelIndex(kCubeFaces, 0, 0, size));
  base::parallelFor(static_cast<std::size_t>(kCubeFaces) * size, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int face = static_cast<int>(row) / size, y = static_cast<int>(row) % size;
      for (int x = 0; x < size; ++x) {
        const glm::vec3 n(texelDirection(face, x, y, size));
        const Frame frame = makeFrame(n);
        glm::vec3 sum{0.f};
        for (const LobeSample& sample : samples) {
          const glm::vec3 direction =
              frame.tangent * sample.direction.x + frame.bitangent * sample.direction.y + n * sample.direction.z;
          sum += sample.weight * glm::vec3(cube.sample(direction, sample.blend));
        }
        mip[texelIndex(face, x, y, size)] = glm::vec4(sum, 1.f);
      }
    }
  });
  return mip;
}

} // namespace parity::lighting
