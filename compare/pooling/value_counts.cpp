#include "compare/pooling/value_counts.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

namespace parity::compare {

ValueCounts::ValueCounts(std::vector<std::size_t> bins)
    : m_bins(std::move(bins)), m_places(ValueBins::kCount), m_counts(m_bins.size() * kValues) {
  for (std::size_t i = 0; i < m_bins.size(); ++i) m_places[m_bins[i]] = static_cast<std::uint8_t>(i + 1);
}

void ValueCounts::add(std::span<const float> values) {
  for (const float value : values) {
    const std::uint8_t place = m_places[static_cast<std::size_t>(ValueBins::indexOf(value))];
    if (place == 0) continue;
    const std::size_t low = std::bit_cast<std::uint32_t>(value) % kValues;
    ++m_counts[(place - 1u) * kValues + low];
  }
}

void ValueCounts::add(const ValueCounts& other) {
  std::ranges::transform(m_counts, other.m_counts, m_counts.begin(), std::plus<>());
}

float ValueCounts::select(std::size_t bin, bool isOwnWeight, double before, double target) const {
  const std::uint32_t* counts = m_counts.data() + (m_places[bin] - 1u) * kValues;
  const auto first =
      static_cast<std::uint32_t>(ValueBins::kLeast) + static_cast<std::uint32_t>((bin - 1) << ValueBins::kShift);
  double running = 0;
  float last = 0;
  for (std::uint32_t low = 0; low < kValues; ++low) {
    if (counts[low] == 0) continue;
    last = std::bit_cast<float>(first + low);
    running += static_cast<double>(counts[low]) * (isOwnWeight ? static_cast<double>(last) : 1.);
    if (before + running > target) break;
  }
  return last;
}

} // namespace parity::compare
