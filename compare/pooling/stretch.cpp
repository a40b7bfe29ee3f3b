#include "compare/pooling/stretch.h"

#include <cstdint>

// Where the loops are plain, the compiler makes vectors of them for each instruction set that Highway names.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/pooling/stretch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

// Lanes of their own, so that the compiler may take them at once without changing the order of any sum.
constexpr std::size_t kLanes = 16;

double Sum(const float* __restrict values, const float* __restrict weights, std::size_t count) {
  double lanes[kLanes] = {};
  std::size_t i = 0;
  if (weights)
    for (; i + kLanes <= count; i += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k)
        lanes[k] += static_cast<double>(values[i + k]) * static_cast<double>(weights[i + k]);
  else
    for (; i + kLanes <= count; i += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += static_cast<double>(values[i + k]);
  for (std::size_t k = 0; i < count; ++i, ++k)
    lanes[k] += static_cast<double>(values[i]) * (weights ? static_cast<double>(weights[i]) : 1.);
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) lanes[k] += lanes[k + half];
  return lanes[0];
}

Extremes FindExtremes(const float* __restrict values, std::size_t count) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  auto low = hn::Set(d, values[0]), high = low;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto v = hn::LoadU(d, values + i);
    low = hn::Min(low, v);
    high = hn::Max(high, v);
  }
  Extremes found{hn::GetLane(hn::MinOfLanes(d, low)), hn::GetLane(hn::MaxOfLanes(d, high))};
  for (; i < count; ++i) {
    found.min = values[i] < found.min ? values[i] : found.min;
    found.max = values[i] > found.max ? values[i] : found.max;
  }
  return found;
}

std::uint32_t CountAbove(const float* __restrict values, std::size_t count, float threshold) {
  std::uint32_t above = 0;
  for (std::size_t i = 0; i < count; ++i) above += values[i] > threshold ? 1u : 0u;
  return above;
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {

HWY_EXPORT(Sum);
HWY_EXPORT(FindExtremes);
HWY_EXPORT(CountAbove);

} // namespace

double sumOf(const Stretch& s) { return HWY_DYNAMIC_DISPATCH(Sum)(s.values, s.weights, s.count); }

Extremes extremesOf(const Stretch& s) { return HWY_DYNAMIC_DISPATCH(FindExtremes)(s.values, s.count); }

double weightAbove(const Stretch& s, float threshold) {
  if (!s.weights) return HWY_DYNAMIC_DISPATCH(CountAbove)(s.values, s.count, threshold);
  double sum = 0;
  for (std::size_t i = 0; i < s.count; ++i)
    if (s.values[i] > threshold) sum += static_cast<double>(s.weights[i]);
  return sum;
}

} // namespace parity::compare
#endif
