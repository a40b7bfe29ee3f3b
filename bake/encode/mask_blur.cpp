#include "bake/encode/mask_blur.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace parity::bake {

namespace {

// Sums over a centred window of a real width, along one line: pixels that it only touches count by the part within.
class WindowSum {
public:
  explicit WindowSum(double width)
      : m_whole(static_cast<int>(std::floor(0.5 * (std::max(width, 1.0) - 1)))),
        m_part(0.5 * (std::max(width, 1.0) - 1) - m_whole) {}

  // values: `count` of them, `stride` apart; replaced.
  void apply(float* values, int count, std::size_t stride) {
    m_sums.assign(static_cast<std::size_t>(count) + 1, 0);
    for (int i = 0; i < count; ++i) m_sums[i + 1] = m_sums[i] + values[i * stride];
    for (int i = 0; i < count; ++i) {
      const auto between = [&](int begin, int end) {
        return m_sums[std::clamp(end, 0, count)] - m_sums[std::clamp(begin, 0, count)];
      };
      const double inner = between(i - m_whole, i + m_whole + 1), outer = between(i - m_whole - 1, i + m_whole + 2);
      values[i * stride] = static_cast<float>(inner + m_part * (outer - inner));
    }
  }

private:
  int m_whole;   // pixels on either side that are within
  double m_part; // of the next
  std::vector<double> m_sums;
};

void sumSquares(base::Image& image, double width) {
  base::parallelFor(static_cast<std::size_t>(image.height), 32, [&](std::size_t begin, std::size_t end) {
    WindowSum window(width);
    for (std::size_t y = begin; y < end; ++y) window.apply(image.at(0, static_cast<int>(y)), image.width, 1);
  });
  base::parallelFor(static_cast<std::size_t>(image.width), 32, [&](std::size_t begin, std::size_t end) {
    WindowSum window(width);
    for (std::size_t x = begin; x < end; ++x)
      window.apply(image.at(static_cast<int>(x), 0), image.height, static_cast<std::size_t>(image.width));
  });
}

} // namespace

ChartMask cutChart(const SunMask& mask, const MaskChart& chart, int margin) {
  ChartMask cut;
  cut.factor = mask.factor;
  cut.texelX = chart.x0 / mask.factor - margin;
  cut.texelY = chart.y0 / mask.factor - margin;
  const int endX = (chart.x1 - 1) / mask.factor + 1 + margin, endY = (chart.y1 - 1) / mask.factor + 1 + margin;
  cut.sight = base::Image8((endX - cut.texelX) * mask.factor, (endY - cut.texelY) * mask.factor, 1, kUnknown);
  for (const MaskChart::Run& run : chart.runs)
    std::copy(mask.sight.at(run.x0, run.y), mask.sight.at(run.x0, run.y) + (run.x1 - run.x0),
              cut.sight.at(run.x0 - cut.texelX * mask.factor, run.y - cut.texelY * mask.factor));
  return cut;
}

base::Image blurMask(const ChartMask& chart, double penumbra) {
  base::Image lit(chart.sight.width, chart.sight.height, 1), known(lit.width, lit.height, 1);
  for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
    lit.pixels[i] = chart.sight.pixels[i] == kLit;
    known.pixels[i] = chart.sight.pixels[i] != kUnknown;
  }
  sumSquares(lit, penumbra * chart.factor);
  sumSquares(known, penumbra * chart.factor);
  for (std::size_t i = 0; i < lit.pixels.size(); ++i)
    lit.pixels[i] = chart.sight.pixels[i] == kUnknown ? 0.f : lit.pixels[i] / known.pixels[i];
  return lit;
}

BilinearTap bilinearTap(int i, int factor) {
  const double at = (i + 0.5) / factor - 0.5, lower = std::floor(at);
  return {static_cast<int>(lower), at - lower};
}

} // namespace parity::bake
