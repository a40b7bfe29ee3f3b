#include "study/explain/ranges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parity::explain {

namespace {

constexpr int kRanges = 10;

// The quantity's ranges from one end: how much of both lies up to each.
void tryFrom(const std::vector<const RangeShare*>& ranges, bool fromBelow, std::optional<RangeShare>& best) {
  RangeShare part{.quantity = ranges.front()->quantity,
                  .from = fromBelow ? 0.0 : 1.0,
                  .to = fromBelow ? 0.0 : 1.0,
                  .pixels = 0,
                  .error = 0};
  for (const RangeShare* range : ranges) {
    (fromBelow ? part.to : part.from) = fromBelow ? range->to : range->from;
    part.pixels += range->pixels;
    part.error += range->error;
    if (part.error < 0.5) continue;
    if (part.pixels <= 0.5 * part.error && (!best || part.pixels < best->pixels)) best = part;
    return;
  }
}

} // namespace

std::vector<RangeShare> sharesOf(const std::string& quantity, const base::PixelList& list, const base::Image& values,
                                 std::span<const float> errors) {
  std::array<double, kRanges> pixels{}, error{};
  double allPixels = 0, allError = 0;
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    const float value = values.pixels[std::size_t{list.pixels[i]} * static_cast<std::size_t>(values.channels)];
    const double weight = list.weights.empty() ? 1 : list.weights[i];
    const float inside = std::isfinite(value) ? std::clamp(value, 0.f, 1.f) : 0.f;
    const auto range = static_cast<std::size_t>(std::min(static_cast<int>(inside * kRanges), kRanges - 1));
    pixels[range] += weight, allPixels += weight;
    error[range] += weight * errors[i], allError += weight * errors[i];
  }
  std::vector<RangeShare> shares;
  for (std::size_t k = 0; k < kRanges; ++k)
    if (pixels[k] > 0)
      shares.push_back({quantity, static_cast<double>(k) / kRanges, static_cast<double>(k + 1) / kRanges,
                        pixels[k] / allPixels, allError > 0 ? error[k] / allError : 0});
  return shares;
}

std::optional<RangeShare> worstPart(const std::vector<RangeShare>& shares) {
  std::optional<RangeShare> best;
  for (auto begin = shares.begin(); begin != shares.end();) {
    const auto end =
        std::find_if(begin, shares.end(), [&](const RangeShare& s) { return s.quantity != begin->quantity; });
    std::vector<const RangeShare*> ranges;
    for (auto each = begin; each != end; ++each) ranges.push_back(&*each);
    tryFrom(ranges, true, best);
    std::ranges::reverse(ranges);
    tryFrom(ranges, false, best);
    begin = end;
  }
  return best;
}

} // namespace parity::explain
