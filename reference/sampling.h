// Sample points (Owen-scrambled Sobol) and the ways to turn them into directions, each with its density.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace parity::reference {

// A mix of two words into one that depends on every bit of both (the finaliser of MurmurHash3, Appleby 2011).
constexpr std::uint32_t hashCombine(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a ^ (b + 0x9e3779b9u + (a << 6) + (a >> 2));
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

constexpr std::uint32_t reverseBits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Nested uniform scrambling of a number whose bits are reversed, by hashing: each bit is flipped depending on those
// below it alone (Laine and Karras 2011; Burley 2020, "Practical Hash-based Owen Scrambling", section 3; constants of
// Vegdahl 2021, "Building a Better LK Hash").
constexpr std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// The second dimension of Sobol's sequence as a 32-bit fraction: the index's bits times Pascal's triangle modulo 2, a
// polynomial shifted by 1 in halves (the first dimension is reverseBits(index)).
constexpr std::uint32_t sobolSecond(std::uint32_t index) {
  std::uint32_t x = reverseBits(index);
  x ^= x << 16;
  x ^= (x & 0x00ff00ffu) << 8;
  x ^= (x & 0x0f0f0f0fu) << 4;
  x ^= (x & 0x33333333u) << 2;
  x ^= (x & 0x55555555u) << 1;
  return x;
}

// The third dimension, by the direction numbers of the primitive polynomial x^2 + x + 1 with m = 1, 3 (Bratley and Fox
// 1988; Joe and Kuo 2008).
inline constexpr std::array<std::uint32_t, 32> kSobolThird = [] {
  std::array<std::uint32_t, 32> v{};
  v[0] = 1u << 31;
  v[1] = 3u << 30;
  for (std::size_t k = 2; k < v.size(); ++k) v[k] = v[k - 1] ^ v[k - 2] ^ (v[k - 2] >> 2);
  return v;
}();
// The same, byte by byte of the index.
inline constexpr std::array<std::array<std::uint32_t, 256>, 4> kSobolThirdOfByte = [] {
  std::array<std::array<std::uint32_t, 256>, 4> sums{};
  for (std::size_t byte = 0; byte < sums.size(); ++byte)
    for (std::size_t value = 0; value < 256; ++value)
      for (std::size_t bit = 0; bit < 8; ++bit)
        if ((value >> bit & 1) != 0) sums[byte][value] ^= kSobolThird[8 * byte + bit];
  return sums;
}();
constexpr std::uint32_t sobolThird(std::uint32_t index) {
  const auto& sums = kSobolThirdOfByte;
  return sums[0][index & 255] ^ sums[1][index >> 8 & 255] ^ sums[2][index >> 16 & 255] ^ sums[3][index >> 24];
}

// Point `index` of the Owen-scrambled Sobol (0,2)-sequence of this seed, in (0, 1)^2. Any 2^k first points are
// stratified in all elementary intervals; sequences of different seeds are independent.
inline glm::dvec2 sobolPoint(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t x = reverseBits(scrambleReversed(index, hashCombine(seed, 1)));
  const std::uint32_t y = reverseBits(scrambleReversed(reverseBits(sobolSecond(index)), hashCombine(seed, 2)));
  return {(x + 0.5) * 0x1p-32, (y + 0.5) * 0x1p-32};
}

// The same with a third coordinate: all three are stratified together.
inline glm::dvec3 sobolPoint3(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t z = reverseBits(scrambleReversed(reverseBits(sobolThird(index)), hashCombine(seed, 3)));
  return glm::dvec3(sobolPoint(index, seed), (z + 0.5) * 0x1p-32);
}

// An index shuffled within blocks of every power of two, so that sequences taken side by side are not stratified alike
// (Burley 2020, section 5): aligned blocks of 2^k indices become other such blocks.
constexpr std::uint32_t shuffleIndex(std::uint32_t index, std::uint32_t seed) {
  return reverseBits(scrambleReversed(reverseBits(index), seed));
}

// Sample points of as many dimensions as a path needs: three at a time, of independent sequences.
class PathPoints {
public:
  PathPoints(std::uint32_t index, std::uint32_t seed) : m_index(index), m_seed(seed) {}
  glm::dvec3 next() {
    const std::uint32_t seed = hashCombine(m_seed, m_count++);
    return sobolPoint3(shuffleIndex(m_index, hashCombine(seed, 4)), seed);
  }

private:
  std::uint32_t m_index, m_seed, m_count = 0;
};

// ---- directions about +Z

// Cosine-distributed over the upper hemisphere; density pdfCosine.
inline glm::dvec3 sampleCosine(const glm::dvec2& u) {
  const double r = std::sqrt(u.x), phi = 2 * std::numbers::pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x)};
}
inline double pdfCosine(double NoL) { return NoL > 0 ? NoL * std::numbers::inv_pi : 0; }

// A half vector of GGX as seen from `view` (unit, view.z > 0): distributed as D G1 max(0, v.h) / v.z (Heitz 2018, eq.
// 2), by spherical caps (Dupuy and Benyoub 2023, listing 3). Alphas in (0, 1].
inline glm::dvec3 sampleVisibleNormal(double alphaX, double alphaY, const glm::dvec3& view, const glm::dvec2& u) {
  const glm::dvec3 v = glm::normalize(glm::dvec3(alphaX * view.x, alphaY * view.y, view.z));
  const double phi = 2 * std::numbers::pi * u.x;
  const double z = (1 - u.y) * (1 + v.z) - v.z;
  const double r = std::sqrt(glm::clamp(1 - z * z, 0.0, 1.0));
  const glm::dvec3 h = glm::dvec3(r * std::cos(phi), r * std::sin(phi), z) + v;
  return glm::normalize(glm::dvec3(alphaX * h.x, alphaY * h.y, h.z));
}
inline glm::dvec3 sampleVisibleNormal(double alpha, const glm::dvec3& view, const glm::dvec2& u) {
  return sampleVisibleNormal(alpha, alpha, view, u);
}

// Density, per steradian of light directions, of the view's mirror image in such a half vector:
//   D G1 / (4 NoV) = D / (2 (NoV + sqrt(alpha^2 + (1 - alpha^2) NoV^2)))
// Heitz 2018, eq. 17, with Smith's G1 of GGX (Walter et al. 2007, eq. 34). D = D_GGX(alpha, NoH).
inline double pdfVisibleNormal(double D, double alpha, double NoV) {
  const double a2 = alpha * alpha;
  return D / (2 * (NoV + std::sqrt(a2 + (1 - a2) * NoV * NoV)));
}

} // namespace parity::reference
