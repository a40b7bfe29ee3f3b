// How often each value of a bin occurs: the way to an order statistic where a bin holds a large part of all values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/pooling/value_histogram.h"

namespace parity::compare {

class ValueCounts {
public:
  // Whether all values of the bin have their leading bits in common, so that the others can be counted.
  static bool canCount(std::size_t bin) { return bin > 0 && bin < ValueBins::kCount - 1; }

  explicit ValueCounts(std::vector<std::size_t> bins); // ascending
  void add(std::span<const float> values);
  void add(const ValueCounts& other); // of the same bins

  // As selectValue() does it for the values of the bin, which has some. Their weights are 1, or the values themselves.
  float select(std::size_t bin, bool isOwnWeight, double before, double target) const;

private:
  static constexpr std::size_t kValues = std::size_t{1} << ValueBins::kShift; // of one bin

  std::vector<std::size_t> m_bins;
  std::vector<std::uint8_t> m_places; // 1 + the place of a bin's counts; 0: not counted
  std::vector<std::uint32_t> m_counts;
};

} // namespace parity::compare
