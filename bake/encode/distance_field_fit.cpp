#include "bake/encode/distance_field_fit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "bake/encode/distance_field.h"
#include "base/parallel.h"

namespace parity::bake {

namespace {

constexpr std::array kSteps = {1, 2, 4, 8, 16, 32, 64};

// The known sub-texels that read one texel.
class Footprint {
public:
  // The codes' own contribution to d but for the texel (x, y), its weight, and the target.
  void gather(const ChartMask& chart, const base::Image& target, const base::Image8& codes, int x, int y) {
    m_samples.clear();
    const int factor = chart.factor, half = factor / 2; // it is read half a texel beyond its own sub-texels
    const int endX = std::min((x + 1) * factor + half, chart.sight.width);
    const int endY = std::min((y + 1) * factor + half, chart.sight.height);
    for (int row = std::max(y * factor - half, 0); row < endY; ++row)
      for (int column = std::max(x * factor - half, 0); column < endX; ++column) {
        if (*chart.sight.at(column, row) == kUnknown) continue;
        const BilinearTap tapX = bilinearTap(column, factor), tapY = bilinearTap(row, factor);
        double own = 0, others = 0;
        for (int k = 0; k < 4; ++k) { // the margin keeps all four within
          const int readX = tapX.lower + (k & 1), readY = tapY.lower + (k >> 1);
          const double weight =
              (k & 1 ? tapX.upperWeight : 1 - tapX.upperWeight) * (k >> 1 ? tapY.upperWeight : 1 - tapY.upperWeight);
          if (readX == x && readY == y)
            own = weight;
          else
            others += weight * *codes.at(readX, readY);
        }
        if (own > 0) m_samples.push_back({others / 255, own / 255, *target.at(column, row)});
      }
  }
  bool empty() const { return m_samples.empty(); }
  double squaredError(int code, double transitionScale) const {
    double sum = 0;
    for (const Sample& s : m_samples) {
      const double error = decodeVisibility(s.others + s.own * code, transitionScale) - s.target;
      sum += error * error;
    }
    return sum;
  }

private:
  struct Sample {
    double others, own, target;
  };
  std::vector<Sample> m_samples;
};

// The texels that some sub-texel reads whose visibility is not its target.
std::vector<std::uint8_t> findWrong(const ChartMask& chart, const base::Image& target, const base::Image8& codes,
                                    double transitionScale) {
  constexpr double kSeen = 1.0 / 512;
  std::vector<std::uint8_t> isWrong(codes.pixels.size(), 0);
  for (int row = 0; row < chart.sight.height; ++row)
    for (int column = 0; column < chart.sight.width; ++column) {
      if (*chart.sight.at(column, row) == kUnknown) continue;
      const BilinearTap tapX = bilinearTap(column, chart.factor), tapY = bilinearTap(row, chart.factor);
      const auto read = [&](int y) {
        return std::lerp(double{1} * *codes.at(tapX.lower, y), double{1} * *codes.at(tapX.lower + 1, y),
                         tapX.upperWeight);
      };
      const double d = std::lerp(read(tapY.lower), read(tapY.lower + 1), tapY.upperWeight) / 255;
      if (std::abs(decodeVisibility(d, transitionScale) - *target.at(column, row)) < kSeen) continue;
      for (int k = 0; k < 4; ++k)
        isWrong[static_cast<std::size_t>(tapY.lower + (k >> 1)) * codes.width + tapX.lower + (k & 1)] = 1;
    }
  return isWrong;
}

} // namespace

void fitCodes(const ChartMask& chart, const base::Image& target, double transitionScale, int sweeps,
              base::Image8& codes) {
  constexpr double kGain = 1e-3; // of the sum over a footprint: what is less is not seen
  // What has nothing to gain may have once its neighbour has changed.
  std::vector<std::uint8_t> isOpen = findWrong(chart, target, codes, transitionScale);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::atomic<bool> hasChanged = false;
    std::vector<std::uint8_t> hasMoved(codes.pixels.size(), 0);
    for (int phase = 0; phase < 4; ++phase)
      base::parallelFor(static_cast<std::size_t>(codes.height + 1) / 2, 8, [&](std::size_t begin, std::size_t end) {
        Footprint footprint;
        for (int y = static_cast<int>(2 * begin) + (phase >> 1); y < std::min(static_cast<int>(2 * end), codes.height);
             y += 2)
          for (int x = phase & 1; x < codes.width; x += 2) {
            const std::size_t index = static_cast<std::size_t>(y) * codes.width + x;
            if (isOpen[index] == 0) continue;
            footprint.gather(chart, target, codes, x, y);
            if (footprint.empty()) continue;
            const int now = *codes.at(x, y);
            double least = footprint.squaredError(now, transitionScale) - kGain;
            int best = now;
            if (least <= 0) continue;
            for (const int step : kSteps)
              for (const int code : {now - step, now + step}) {
                if (code < 0 || code > 255) continue;
                const double error = footprint.squaredError(code, transitionScale);
                if (error < least) least = error, best = code;
              }
            if (best == now) continue;
            *codes.at(x, y) = static_cast<std::uint8_t>(best);
            hasMoved[index] = 1;
            hasChanged = true;
          }
      });
    if (!hasChanged) return;
    std::fill(isOpen.begin(), isOpen.end(), 0);
    for (int y = 0; y < codes.height; ++y)
      for (int x = 0; x < codes.width; ++x) {
        if (hasMoved[static_cast<std::size_t>(y) * codes.width + x] == 0) continue;
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, codes.height - 1); ++row)
          for (int column = std::max(x - 1, 0); column <= std::min(x + 1, codes.width - 1); ++column)
            isOpen[static_cast<std::size_t>(row) * codes.width + column] = 1;
      }
  }
}

} // namespace parity::bake
