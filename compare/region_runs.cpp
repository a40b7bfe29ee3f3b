#include "compare/region_runs.h"

#include <algorithm>
#include <cstddef>

#include "compare/region_list.h"

namespace parity::compare {
namespace {

// Columns begin .. end-1 of a row.
struct Interval {
  int begin, end;
};

// Sets of columns for a range of rows, each as ascending intervals that do not touch.
struct RowSets {
  std::vector<Interval> intervals;
  std::vector<std::size_t> starts{0}; // row i holds intervals starts[i] .. starts[i+1]-1

  std::size_t rows() const { return starts.size() - 1; }
  std::span<const Interval> row(std::size_t i) const {
    return {intervals.data() + starts[i], starts[i + 1] - starts[i]};
  }
  void endRow() { starts.push_back(intervals.size()); }
};

void appendIntersection(RowSets& out, std::span<const Interval> a, std::span<const Interval> b) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Interval both{std::max(a[i].begin, b[j].begin), std::min(a[i].end, b[j].end)};
    if (both.begin < both.end) out.intervals.push_back(both);
    if (a[i].end < b[j].end)
      ++i;
    else
      ++j;
  }
  out.endRow();
}

// Row i of the result is what rows i and i+step have in common.
RowSets intersectShifted(const RowSets& sets, std::size_t step) {
  RowSets out;
  out.intervals.reserve(sets.intervals.size());
  for (std::size_t i = 0; i + step < sets.rows(); ++i) appendIntersection(out, sets.row(i), sets.row(i + step));
  return out;
}

void addRun(RegionRuns& region, const Run& run) {
  region.runs.push_back(run);
  region.pixels += run.count;
  const float* weights = region.weightsOf(run);
  if (!weights)
    region.weight += run.count;
  else
    for (std::uint32_t i = 0; i < run.count; ++i) region.weight += static_cast<double>(weights[i]);
}

// Runs shortened by the radius at both ends that are not the image's, for rows top-radius .. bottom+radius. The rows
// beyond the image repeat its first and last: that adds no condition, as those are in the same windows.
RowSets erodeRows(const RegionRuns& region, int width, int height, int radius) {
  const auto w = static_cast<std::uint32_t>(width);
  const int top = static_cast<int>(region.runs.front().first / w),
            bottom = static_cast<int>(region.runs.back().first / w);
  RowSets rows;
  std::size_t next = 0;
  for (int y = top; y <= bottom; ++y) {
    for (; next < region.runs.size() && static_cast<int>(region.runs[next].first / w) == y; ++next) {
      const Run& run = region.runs[next];
      const int begin = static_cast<int>(run.first % w), end = begin + static_cast<int>(run.count);
      const Interval inner{begin == 0 ? 0 : begin + radius, end == width ? width : end - radius};
      if (inner.begin < inner.end) rows.intervals.push_back(inner);
    }
    rows.endRow();
  }
  RowSets out;
  for (int y = top - radius; y <= bottom + radius; ++y) {
    const int inside = std::clamp(y, 0, height - 1);
    if (inside >= top && inside <= bottom) {
      const auto row = rows.row(static_cast<std::size_t>(inside - top));
      out.intervals.insert(out.intervals.end(), row.begin(), row.end());
    }
    out.endRow();
  }
  return out;
}

} // namespace

RegionRuns runsOf(const base::PixelList& list, int width, int height) {
  requireWellFormed(list, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  RegionRuns region;
  region.weights = list.weights;
  const auto w = static_cast<std::uint32_t>(width);
  const auto isMember = [&](std::size_t i) { return list.weights.empty() || list.weights[i] > 0; };
  for (std::size_t i = 0; i < list.pixels.size();) {
    const std::size_t start = i++;
    if (!isMember(start)) continue;
    const std::uint32_t first = list.pixels[start];
    const std::uint64_t rowEnd = (std::uint64_t{first} / w + 1) * w;
    while (i < list.pixels.size() && list.pixels[i] == first + (i - start) && list.pixels[i] < rowEnd && isMember(i))
      ++i;
    addRun(region, {first, static_cast<std::uint32_t>(i - start), static_cast<std::uint32_t>(start)});
  }
  return region;
}

RegionRuns erodeRuns(const RegionRuns& region, int width, int height, int radius) {
  RegionRuns out;
  out.weights = region.weights;
  if (region.runs.empty()) return out;
  // Row i of `sets` is what `span` rows from there on have in common; a window is two such spans that overlap.
  RowSets sets = erodeRows(region, width, height, radius);
  const auto window = static_cast<std::size_t>(2 * radius + 1);
  std::size_t span = 1;
  for (; 2 * span <= window; span *= 2) sets = intersectShifted(sets, span);
  if (window > span) sets = intersectShifted(sets, window - span);

  const auto w = static_cast<std::uint32_t>(width);
  const std::uint32_t top = region.runs.front().first / w;
  std::size_t within = 0; // the run that holds the interval: there is just one
  for (std::size_t i = 0; i < sets.rows(); ++i)
    for (const Interval& interval : sets.row(i)) {
      const std::uint32_t first =
          (top + static_cast<std::uint32_t>(i)) * w + static_cast<std::uint32_t>(interval.begin);
      while (region.runs[within].first + region.runs[within].count <= first) ++within;
      const Run& run = region.runs[within];
      addRun(out,
             {first, static_cast<std::uint32_t>(interval.end - interval.begin), run.weightAt + (first - run.first)});
    }
  return out;
}

} // namespace parity::compare
