// Weighted order statistics by radix selection: histograms of the leading bits, then of the next within the bin found.
#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "compare/metrics.h"

namespace parity::compare {
namespace {

// The bits of a float as an integer of the same order.
std::uint32_t orderedKey(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}
float valueOfKey(std::uint32_t key) { return std::bit_cast<float>(key & 0x80000000u ? key & 0x7fffffffu : ~key); }

// The 32 bits of a key in groups, from the leading one.
struct Level {
  int shift, bits;
};
constexpr std::array<Level, 3> kLevels = {{{21, 11}, {10, 11}, {0, 10}}};

struct Entry {
  std::uint32_t key;
  float weight;
};

std::size_t binOf(const Entry& entry, const Level& level) {
  return entry.key >> level.shift & ((std::uint32_t{1} << level.bits) - 1);
}

using Histogram = std::vector<double>; // weight per bin

Histogram count(const std::vector<Entry>& entries, const Level& level) {
  Histogram bins(std::size_t{1} << level.bits, 0.);
  for (const Entry& entry : entries) bins[binOf(entry, level)] += static_cast<double>(entry.weight);
  return bins;
}

std::vector<Entry> entriesOfBin(const std::vector<Entry>& entries, const Level& level, std::size_t bin) {
  std::vector<Entry> out;
  for (const Entry& entry : entries)
    if (binOf(entry, level) == bin) out.push_back(entry);
  return out;
}

struct Found {
  std::size_t bin;
  double before; // weight in the bins before it
};

// The first bin at whose end the running weight exceeds `target`; the last that holds any where rounding lets none.
Found findBin(const Histogram& bins, double before, double target) {
  Found last{0, before};
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i] <= 0) continue;
    last = {i, before};
    before += bins[i];
    if (before > target) break;
  }
  return last;
}

} // namespace

std::vector<float> weightedPercentiles(std::span<const float> values, std::span<const float> weights,
                                       std::span<const double> fractions) {
  const auto refuse = [](const char* reason) { return base::Error(base::ExitCode::failed, "percentiles", "", reason); };
  if (values.empty()) throw refuse("there are no values");
  if (!weights.empty() && weights.size() != values.size()) throw refuse("there are not as many weights as values");
  std::vector<Entry> entries(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float weight = weights.empty() ? 1.f : weights[i];
    if (std::isnan(values[i])) throw refuse("a value is NaN");
    if (!(weight >= 0 && std::isfinite(weight))) throw refuse("a weight is negative or not finite");
    entries[i] = {orderedKey(values[i]), weight};
  }
  const Histogram top = count(entries, kLevels[0]);
  double total = 0;
  for (double weight : top) total += weight;
  if (!(total > 0)) throw refuse("all weights are 0");

  std::vector<float> out;
  for (double fraction : fractions) {
    if (!(fraction >= 0 && fraction <= 1)) throw refuse("a fraction is not in [0,1]");
    const double target = fraction * total;
    Found found = findBin(top, 0, target);
    std::vector<Entry> candidates = entriesOfBin(entries, kLevels[0], found.bin);
    auto key = static_cast<std::uint32_t>(found.bin);
    for (std::size_t i = 1; i < kLevels.size(); ++i) {
      found = findBin(count(candidates, kLevels[i]), found.before, target);
      candidates = entriesOfBin(candidates, kLevels[i], found.bin);
      key = key << kLevels[i].bits | static_cast<std::uint32_t>(found.bin);
    }
    out.push_back(valueOfKey(key));
  }
  return out;
}

} // namespace parity::compare
