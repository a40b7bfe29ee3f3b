#include "compare/pooling/scaled_weights.h"

#include <algorithm>

namespace parity::compare {

ScaledWeights::ScaledWeights(const RegionRuns& region, int width, int height, int halvings) {
  int x0 = width, x1 = 0;
  for (const Run& run : region.runs) {
    const int x = static_cast<int>(run.first) % width;
    x0 = std::min(x0, x), x1 = std::max(x1, x + static_cast<int>(run.count));
  }
  const int y0 = static_cast<int>(region.runs.front().first) / width,
            y1 = static_cast<int>(region.runs.back().first) / width + 1;
  // Whole blocks of the coarsest scale, so that no block of 2x2 is cut on the way.
  const int block = 1 << halvings;
  m_x = x0 / block * block;
  m_y = y0 / block * block;
  const auto roundUp = [&](int v, int limit) { return std::min((v + block - 1) / block * block, limit); };
  m_weights = base::Image(roundUp(x1, width) - m_x, roundUp(y1, height) - m_y, 1);
  for (const Run& run : region.runs) {
    float* out = m_weights.at(static_cast<int>(run.first) % width - m_x, static_cast<int>(run.first) / width - m_y);
    if (const float* weights = region.weightsOf(run))
      std::copy_n(weights, run.count, out);
    else
      std::fill_n(out, run.count, 1.f);
  }
}

void ScaledWeights::halve() {
  base::Image out((m_weights.width + 1) / 2, (m_weights.height + 1) / 2, 1);
  for (int y = 0; y < out.height; ++y) {
    const int rows = std::min(2, m_weights.height - 2 * y);
    for (int x = 0; x < out.width; ++x) {
      const int columns = std::min(2, m_weights.width - 2 * x);
      float sum = 0;
      for (int v = 0; v < rows; ++v)
        for (int u = 0; u < columns; ++u) sum += *m_weights.at(2 * x + u, 2 * y + v);
      *out.at(x, y) = sum / static_cast<float>(rows * columns);
    }
  }
  m_weights = std::move(out);
  m_x /= 2, m_y /= 2;
}

double ScaledWeights::meanOf(const base::Image& plane) const {
  double sum = 0, total = 0;
  for (int y = 0; y < m_weights.height; ++y) {
    const float *values = plane.at(m_x, m_y + y), *weights = m_weights.at(0, y);
    for (int x = 0; x < m_weights.width; ++x) {
      sum += static_cast<double>(weights[x]) * static_cast<double>(values[x]);
      total += static_cast<double>(weights[x]);
    }
  }
  return sum / total;
}

} // namespace parity::compare
