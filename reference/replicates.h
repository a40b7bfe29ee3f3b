// Sums over independently scrambled sample points, doubled until their scatter says that the error is small enough.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "reference/environment_integral.h"

namespace parity::reference {

struct Sum {
  glm::dvec3 diffuse{0.0}, specular{0.0};
};

// Mean over the replicates, `points` each, and its standard error.
Integral meanOf(const std::array<Sum, kReplicates>& sums, std::uint32_t points);

inline double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// add(sum, replicate, begin, end) adds points [begin, end) of one replicate; isDone(integral) says whether its error is
// small enough. options.relativeError is left to the latter.
template <typename Add, typename IsDone>
Integral sumReplicates(const IntegralOptions& options, const Add& add, const IsDone& isDone) {
  const auto pointsOf = [](int samples) {
    return std::bit_ceil(static_cast<std::uint32_t>(std::max(1, (samples + kReplicates - 1) / kReplicates)));
  };
  const std::uint32_t most = std::max(pointsOf(options.maxSamples), pointsOf(options.minSamples));
  std::array<Sum, kReplicates> sums{};
  Integral result;
  std::uint32_t done = 0;
  for (std::uint32_t wanted = pointsOf(options.minSamples); wanted <= most; wanted *= 2) {
    for (int r = 0; r < kReplicates; ++r) add(sums[static_cast<std::size_t>(r)], r, done, wanted);
    done = wanted;
    result = meanOf(sums, done);
    if (isDone(result)) break;
  }
  return result;
}

} // namespace parity::reference
