#include "compare/pooling/value_histogram.h"

#include <algorithm>

namespace parity::compare {
namespace {

constexpr std::size_t kBlock = 256; // values whose bins are computed before any is counted

template <bool kWeighted> void addBlocks(const float* values, const float* weights, std::size_t count,
                                         ValueHistogram& even, ValueHistogram& odd) {
  std::int32_t index[kBlock];
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t n = std::min(kBlock, count - begin);
    const float* v = values + begin;
    for (std::size_t i = 0; i < n; ++i) index[i] = ValueBins::indexOf(v[i]);
    const auto weightOf = [&](std::size_t i) {
      if constexpr (kWeighted) return static_cast<double>(weights[begin + i]);
      return 1.;
    };
    std::size_t i = 0;
    for (; i + 2 <= n; i += 2) {
      even[static_cast<std::size_t>(index[i])] += weightOf(i);
      odd[static_cast<std::size_t>(index[i + 1])] += weightOf(i + 1);
    }
    if (i < n) even[static_cast<std::size_t>(index[i])] += weightOf(i);
  }
}

} // namespace

void HistogramBuilder::add(const float* values, const float* weights, std::size_t count) {
  if (weights)
    addBlocks<true>(values, weights, count, m_even, m_odd);
  else
    addBlocks<false>(values, weights, count, m_even, m_odd);
}

ValueHistogram HistogramBuilder::total() const {
  ValueHistogram sum;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = m_even[i] + m_odd[i];
  return sum;
}

FoundBin findBin(std::span<const double> weightPerBin, double before, double target) {
  FoundBin last{0, before};
  for (std::size_t i = 0; i < weightPerBin.size(); ++i) {
    if (weightPerBin[i] <= 0) continue;
    last = {i, before};
    before += weightPerBin[i];
    if (before > target) break;
  }
  return last;
}

float selectValue(std::span<WeightedValue> values, double before, double target) {
  while (values.size() > 1) {
    const auto middle = static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), values.begin() + middle, values.end(),
                     [](const WeightedValue& a, const WeightedValue& b) { return a.value < b.value; });
    double lower = 0;
    for (const WeightedValue& v : values.first(static_cast<std::size_t>(middle)))
      lower += static_cast<double>(v.weight);
    if (before + lower > target) {
      values = values.first(static_cast<std::size_t>(middle));
    } else {
      before += lower;
      values = values.subspan(static_cast<std::size_t>(middle));
    }
  }
  return values.front().value;
}

} // namespace parity::compare
