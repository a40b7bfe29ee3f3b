// A histogram of floats by their leading bits, and the exact order statistics that it leads to.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace parity::compare {

// Bins of 64 to the octave for values in [2^-14, 2^8), one below (zero and negative ones too) and one above: bins are
// in the order of the values, and hold few each where errors lie.
struct ValueBins {
  static constexpr std::int32_t kShift = 17, kLeast = (127 - 14) << 23, kInner = 22 * 64;
  static constexpr std::size_t kCount = kInner + 2;

  static std::int32_t indexOf(float value) {
    const std::int32_t bits = std::bit_cast<std::int32_t>(value); // ascending for values >= 0, negative for the rest
    const std::int32_t raised = bits < kLeast - 1 ? kLeast - 1 : bits;
    const std::int32_t index = ((raised - kLeast) >> kShift) + 1;
    return index < kInner + 1 ? index : kInner + 1;
  }
};

// Weight per bin.
using ValueHistogram = std::array<double, ValueBins::kCount>;

// Adds values with their weights (null: all 1). Two tables, used in turn, so that neighbours of equal value do not wait
// for each other.
class HistogramBuilder {
public:
  void add(const float* values, const float* weights, std::size_t count);
  ValueHistogram total() const;

private:
  ValueHistogram m_even{}, m_odd{};
};

struct WeightedValue {
  float value, weight;
};

// Where an order statistic lies: the first bin at whose end the running weight exceeds `target`; the last that holds
// any where rounding lets none.
struct FoundBin {
  std::size_t bin = 0;
  double before = 0; // weight in the bins before it
};
FoundBin findBin(std::span<const double> weightPerBin, double before, double target);

// The first value, ascending, at which `before` plus the running weight exceeds `target`; the largest where rounding
// lets none. By halves: O(values). values: not empty, no NaN, all of weight > 0; are put into another order.
float selectValue(std::span<WeightedValue> values, double before, double target);

} // namespace parity::compare
