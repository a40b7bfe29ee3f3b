// The sum over a cube's brightest texels: a block of a vector belongs to one normal, its four lanes to four texels.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/environment/bright_texels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/environment/bright_texels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lighting/environment/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

// kBlocks normals at once: the sums of all four lanes of each block, by channel.
HWY_INLINE void sumOfBlocks(const BrightTexels& texels, const glm::vec3* const (&normals)[kBlocks], float a2,
                            glm::dvec3 (&totals)[kBlocks]) {
  const D d;
  const V zero = hn::Zero(d), one = set(1.f), width = set(a2);
  V normal[3], sums[3] = {zero, zero, zero};
  for (int c = 0; c < 3; ++c)
    normal[c] = fillBlocks(d, [&](std::size_t block) HWY_ATTR { return &(*normals[block])[c]; });
  for (const BrightTexels::Four& four : texels.fours) {
    const auto repeat = [](const Float4& v) HWY_ATTR { return repeatBlock(reinterpret_cast<const float*>(&v)); };
    const V dx = hn::Sub(repeat(four.direction[0]), normal[0]), dy = hn::Sub(repeat(four.direction[1]), normal[1]),
            dz = hn::Sub(repeat(four.direction[2]), normal[2]);
    // (1 - NoL) / 2 without its cancellation
    const V u = hn::Mul(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), set(0.25f));
    const V NoL = hn::Sub(one, hn::Mul(set(2.f), u)), t = hn::Add(u, hn::Mul(width, hn::Sub(one, u)));
    const V weight = hn::Div(hn::Max(NoL, zero), hn::Mul(t, t));
    for (int c = 0; c < 3; ++c) sums[c] = hn::Add(sums[c], hn::Mul(weight, repeat(four.energy[c])));
  }
  alignas(64) float lanes[kLanes];
  for (int c = 0; c < 3; ++c) {
    hn::Store(sums[c], d, lanes);
    for (std::size_t block = 0; block < kBlocks; ++block) {
      const float* of = lanes + 4 * block;
      totals[block][c] = double{of[0]} + of[1] + of[2] + of[3];
    }
  }
}

void SumBrightTexels(const BrightTexels& texels, std::span<const glm::vec3> normals, float a2, double scale,
                     std::span<glm::vec3> sums) {
  for (std::size_t begin = 0; begin < normals.size(); begin += kBlocks) {
    const glm::vec3* blocks[kBlocks]; // what is left over repeats the last
    for (std::size_t i = 0; i < kBlocks; ++i) blocks[i] = &normals[std::min(begin + i, normals.size() - 1)];
    glm::dvec3 totals[kBlocks];
    sumOfBlocks(texels, blocks, a2, totals);
    for (std::size_t i = 0; i < std::min(kBlocks, normals.size() - begin); ++i)
      sums[begin + i] = glm::vec3(scale * totals[i]);
  }
}

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::lighting {
namespace {

HWY_EXPORT(SumBrightTexels);

// integral NoL / t^2 dl over the hemisphere, where t = u + a^2 (1 - u), u = (1 - NoL) / 2 and a = alpha: D is a^2 / pi
// times 1 / t^2, and so in both of numerator and denominator.
double integrateLobe(double alpha) {
  const double a2 = alpha * alpha, b = 1 - a2;
  if (b < 1e-6) return std::numbers::pi;
  const double v = (1 + a2) / 2; // t at the horizon
  return 4 * std::numbers::pi / b * ((1 + 2 * a2 / b) * (1 / a2 - 1 / v) - 2 / b * std::log(v / a2));
}

} // namespace

void sumBrightTexels(const BrightTexels& texels, std::span<const glm::vec3> normals, double roughness,
                     std::span<glm::vec3> sums) {
  const double alpha = roughness * roughness;
  HWY_DYNAMIC_DISPATCH(SumBrightTexels)
  (texels, normals, static_cast<float>(alpha * alpha), 1 / integrateLobe(alpha), sums);
}

} // namespace parity::lighting
#endif
