#include "compare/pooling/pooling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/metrics/metrics.h"
#include "compare/pooling/pieces.h"
#include "compare/pooling/stretch.h"
#include "compare/pooling/value_counts.h"
#include "compare/pooling/value_histogram.h"

namespace parity::compare {
namespace {

using Buckets = std::array<std::uint64_t, 100>;

// What one task adds up.
struct Partial {
  double sum = 0;
  float min = std::numeric_limits<float>::infinity(), max = -min;
  std::vector<double> above;                   // weight above each threshold
  std::unique_ptr<HistogramBuilder> histogram; // where percentiles are wanted
  Buckets buckets{};                           // where they are wanted
};

// What is to be added up. plain: mean and buckets of a map that is its own weight for the percentiles.
struct Task {
  const DistributionRequest& request;
  bool plain = false;
  bool sumOnly = false;
};

// What the weights of values are.
enum class Weights { one, values, any };

// A region's values cut into tasks, the same whatever the number of threads.
class Pieces {
public:
  Pieces(const base::Image& plane, const RegionRuns& region)
      : m_weights(region.weights.empty() ? Weights::one : Weights::any) {
    for (std::size_t run = 0; run < region.runs.size();) run = addPiece(plane, region, run);
  }
  Pieces(std::span<const float> values, const float* weights)
      : m_weights(!weights                   ? Weights::one
                  : weights == values.data() ? Weights::values
                                             : Weights::any) {
    for (std::size_t begin = 0; begin < values.size(); begin += kPiecePixels) {
      const std::size_t count = std::min(kPiecePixels, values.size() - begin);
      m_stretches.push_back({values.data() + begin, weights ? weights + begin : nullptr, count});
      m_ends.push_back(m_stretches.size());
    }
  }
  std::size_t size() const { return m_ends.size(); }
  Weights weights() const { return m_weights; }
  std::span<const Stretch> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : m_ends[i - 1];
    return {m_stretches.data() + begin, m_ends[i] - begin};
  }

private:
  std::size_t addPiece(const base::Image& plane, const RegionRuns& region, std::size_t run) {
    for (const std::size_t end = endOfPiece(region, run); run < end; ++run) {
      const Run& r = region.runs[run];
      m_stretches.push_back({plane.pixels.data() + r.first, region.weightsOf(r), r.count});
    }
    m_ends.push_back(m_stretches.size());
    return run;
  }

  Weights m_weights;
  std::vector<Stretch> m_stretches;
  std::vector<std::size_t> m_ends;
};

void addBuckets(Buckets& buckets, const Stretch& s) {
  for (std::size_t i = 0; i < s.count; ++i) {
    const float v = s.values[i] > 0.f ? s.values[i] : 0.f; // NaN too: it is refused later
    ++buckets[static_cast<std::size_t>(std::min(v * 100.f, 99.f))];
  }
}

Partial poolPiece(std::span<const Stretch> stretches, const Task& task) {
  const DistributionRequest& request = task.request;
  Partial partial;
  partial.above.assign(request.thresholds.size(), 0.);
  if (!request.fractions.empty()) partial.histogram = std::make_unique<HistogramBuilder>();
  for (const Stretch& s : stretches) {
    partial.sum += sumOf(task.plain ? Stretch{s.values, nullptr, s.count} : s);
    if (task.sumOnly) continue;
    const Extremes extremes = extremesOf(s);
    partial.min = std::min(partial.min, extremes.min);
    partial.max = std::max(partial.max, extremes.max);
    for (std::size_t t = 0; t < request.thresholds.size(); ++t)
      partial.above[t] += weightAbove(s, static_cast<float>(request.thresholds[t]));
    if (partial.histogram) partial.histogram->add(s.values, s.weights, s.count);
    if (task.plain) addBuckets(partial.buckets, s);
  }
  return partial;
}

// All pieces together.
struct Sums {
  Partial all;
  ValueHistogram histogram{};
};

Sums poolPieces(const Pieces& pieces, const Task& task) {
  std::vector<Partial> partials(pieces.size());
  base::parallelFor(pieces.size(), 1,
                    [&](std::size_t piece, std::size_t) { partials[piece] = poolPiece(pieces[piece], task); });
  Sums sums;
  Partial& all = sums.all;
  all.above.assign(task.request.thresholds.size(), 0.);
  for (const Partial& partial : partials) {
    all.sum += partial.sum;
    all.min = std::min(all.min, partial.min);
    all.max = std::max(all.max, partial.max);
    for (std::size_t t = 0; t < all.above.size(); ++t) all.above[t] += partial.above[t];
    for (std::size_t i = 0; i < all.buckets.size(); ++i) all.buckets[i] += partial.buckets[i];
    if (!partial.histogram) continue;
    const ValueHistogram part = partial.histogram->total();
    for (std::size_t i = 0; i < part.size(); ++i) sums.histogram[i] += part[i];
  }
  return sums;
}

// The values of weight > 0 in the bins, one list a bin. bins: ascending, each once.
std::vector<std::vector<WeightedValue>> valuesOfBins(const Pieces& pieces, const std::vector<std::size_t>& bins) {
  std::array<std::uint8_t, ValueBins::kCount> listOf{}; // 1 + the place of the bin's list; 0: not wanted
  for (std::size_t i = 0; i < bins.size(); ++i) listOf[bins[i]] = static_cast<std::uint8_t>(i + 1);
  std::vector<std::vector<std::vector<WeightedValue>>> found(pieces.size());
  base::parallelFor(pieces.size(), 1, [&](std::size_t piece, std::size_t) {
    auto& lists = found[piece];
    lists.resize(bins.size());
    for (const Stretch& s : pieces[piece])
      for (std::size_t i = 0; i < s.count; ++i) {
        const std::uint8_t list = listOf[static_cast<std::size_t>(ValueBins::indexOf(s.values[i]))];
        if (list == 0) continue;
        const float weight = s.weights ? s.weights[i] : 1.f;
        if (weight > 0) lists[list - 1u].push_back({s.values[i], weight});
      }
  });
  std::vector<std::vector<WeightedValue>> all(bins.size());
  for (const auto& lists : found)
    for (std::size_t i = 0; i < lists.size(); ++i) all[i].insert(all[i].end(), lists[i].begin(), lists[i].end());
  return all;
}

// The counts of the values in the bins. Each thread's table has .5 MB for a bin, so there are a few at most.
ValueCounts countValues(const Pieces& pieces, const std::vector<std::size_t>& bins) {
  const std::size_t tables = std::min({pieces.size(), static_cast<std::size_t>(base::threadCount()), std::size_t{8}});
  std::vector<ValueCounts> counts(tables, ValueCounts(bins));
  base::parallelFor(tables, 1, [&](std::size_t t, std::size_t) {
    for (std::size_t piece = t; piece < pieces.size(); piece += tables)
      for (const Stretch& s : pieces[piece]) counts[t].add({s.values, s.count});
  });
  for (std::size_t t = 1; t < tables; ++t) counts[0].add(counts[t]);
  return std::move(counts[0]);
}

std::vector<double> percentilesOf(const Pieces& pieces, const Sums& sums, std::span<const double> fractions) {
  if (fractions.empty()) return {};
  if (sums.all.min == sums.all.max) // nothing to look for
    return std::vector<double>(fractions.size(), static_cast<double>(sums.all.max));
  const double total = std::accumulate(sums.histogram.begin(), sums.histogram.end(), 0.);
  std::vector<FoundBin> found;
  std::vector<std::size_t> bins;
  for (const double fraction : fractions) {
    found.push_back(findBin(sums.histogram, 0, fraction * total));
    bins.push_back(found.back().bin);
  }
  std::sort(bins.begin(), bins.end());
  bins.erase(std::unique(bins.begin(), bins.end()), bins.end());
  // Of a bin that holds many, a list would take more than the map does.
  constexpr double kLargeShare = 1. / 64;
  std::vector<std::size_t> large;
  if (pieces.weights() != Weights::any)
    std::erase_if(bins, [&](std::size_t bin) {
      const bool isLarge = ValueCounts::canCount(bin) && sums.histogram[bin] > kLargeShare * total;
      if (isLarge) large.push_back(bin);
      return isLarge;
    });
  std::optional<ValueCounts> counts;
  if (!large.empty()) counts = countValues(pieces, large);
  std::vector<std::vector<WeightedValue>> values;
  if (!bins.empty()) values = valuesOfBins(pieces, bins);
  std::vector<double> out;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const FoundBin& at = found[i];
    if (std::ranges::binary_search(large, at.bin)) {
      out.push_back(static_cast<double>(
          counts->select(at.bin, pieces.weights() == Weights::values, at.before, fractions[i] * total)));
      continue;
    }
    const auto list = std::lower_bound(bins.begin(), bins.end(), at.bin) - bins.begin();
    out.push_back(
        static_cast<double>(selectValue(values[static_cast<std::size_t>(list)], at.before, fractions[i] * total)));
  }
  return out;
}

} // namespace

Distribution poolPlane(const base::Image& plane, const RegionRuns& region, const DistributionRequest& request) {
  const Pieces pieces(plane, region);
  const Sums sums = poolPieces(pieces, {request});
  Distribution out;
  out.mean = sums.all.sum / region.weight;
  out.min = static_cast<double>(sums.all.min);
  out.max = static_cast<double>(sums.all.max);
  for (const double above : sums.all.above) out.shares.push_back(std::min(above / region.weight, 1.));
  out.percentiles = percentilesOf(pieces, sums, request.fractions);
  return out;
}

double meanOf(const base::Image& plane, const RegionRuns& region) {
  const DistributionRequest nothing;
  return poolPieces(Pieces(plane, region), {nothing, false, true}).all.sum / region.weight;
}

double largestOf(const base::Image& plane, const RegionRuns& region) { return poolPlane(plane, region).max; }

Pooling poolMap(const base::Image& map) {
  const auto refuse = [](const std::string& reason) { return base::Error(base::ExitCode::failed, "map", "", reason); };
  if (map.channels != 1 || map.empty()) throw refuse("has " + std::to_string(map.channels) + " channels, not 1");
  const DistributionRequest quartiles{{0.25, 0.5, 0.75}, {}};
  const Pieces pieces(map.pixels, map.pixels.data());
  const Sums sums = poolPieces(pieces, {quartiles, true});
  if (!std::isfinite(sums.all.sum)) requireFinite(map, "map");
  if (sums.all.min < 0) throw refuse("holds negative values, the least is " + std::to_string(sums.all.min));

  Pooling out;
  out.mean = sums.all.sum / static_cast<double>(map.pixels.size());
  out.min = static_cast<double>(sums.all.min);
  out.max = static_cast<double>(sums.all.max);
  out.histogram = sums.all.buckets;
  const std::vector<double> found = percentilesOf(pieces, sums, quartiles.fractions);
  out.weightedQ1 = found[0];
  out.weightedMedian = found[1];
  out.weightedQ3 = found[2];
  return out;
}

std::vector<float> weightedPercentiles(std::span<const float> values, std::span<const float> weights,
                                       std::span<const double> fractions) {
  const auto refuse = [](const char* reason) { return base::Error(base::ExitCode::failed, "percentiles", "", reason); };
  if (values.empty()) throw refuse("there are no values");
  if (!weights.empty() && weights.size() != values.size())
    throw refuse("the number of weights is not the number of values");
  if (std::any_of(values.begin(), values.end(), [](float v) { return std::isnan(v); })) throw refuse("a value is NaN");
  if (std::any_of(weights.begin(), weights.end(), [](float w) { return !(w >= 0 && std::isfinite(w)); }))
    throw refuse("a weight is negative or not finite");
  if (std::none_of(weights.begin(), weights.end(), [](float w) { return w > 0; }) && !weights.empty())
    throw refuse("all weights are 0");
  if (std::any_of(fractions.begin(), fractions.end(), [](double p) { return !(p >= 0 && p <= 1); }))
    throw refuse("a fraction is not in [0,1]");
  const DistributionRequest request{{fractions.begin(), fractions.end()}, {}};
  const Pieces pieces(values, weights.empty() ? nullptr : weights.data());
  std::vector<float> out;
  for (const double found : percentilesOf(pieces, poolPieces(pieces, {request}), request.fractions))
    out.push_back(static_cast<float>(found));
  return out;
}

} // namespace parity::compare
