#include "compare/ssim_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace parity::compare {
namespace {

constexpr int kRadius = 5;
constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;
// A task's tile: the filtered rows of it stay in the second-level cache.
constexpr int kTileWidth = 192, kTileHeight = 64;

// Of the sums s = x + y - 1 and differences d = x - y, and of their squares: from these all moments follow. d is exactly
// 0 where the images are identical, and s about 0 for mid-greys, so that less cancels in its variance.
enum Plane { kSum, kDifference, kSumSquared, kDifferenceSquared, kPlanes };

// exp(-i^2 / (2 1.5^2)), i = 0..5; the whole of 11 sums to 1.
std::array<float, kRadius + 1> makeKernel() {
  std::array<double, kRadius + 1> raw{};
  double sum = 0;
  for (int i = 0; i <= kRadius; ++i) {
    raw[static_cast<std::size_t>(i)] = std::exp(-i * i / (2 * 1.5 * 1.5));
    sum += (i == 0 ? 1 : 2) * raw[static_cast<std::size_t>(i)];
  }
  std::array<float, kRadius + 1> kernel{};
  for (std::size_t i = 0; i < kernel.size(); ++i) kernel[i] = static_cast<float>(raw[i] / sum);
  return kernel;
}

// ... c b a | a b c ... of any distance.
int mirror(int i, int count) {
  const int period = 2 * count;
  const int inside = ((i % period) + period) % period;
  return inside < count ? inside : period - 1 - inside;
}

class Tile {
public:
  Tile(const base::Image& reference, const base::Image& test, const Rect& area)
      : m_reference(reference), m_test(test), m_area(area),
        m_padded(static_cast<std::size_t>(area.width) + 2 * kRadius), m_width(static_cast<std::size_t>(area.width)),
        m_in(kPlanes * m_padded), m_rows(kPlanes * m_width * (static_cast<std::size_t>(area.height) + 2 * kRadius)),
        m_out(kPlanes * m_width) {}

  void run(SsimMaps& maps) {
    for (int i = 0; i < m_area.height + 2 * kRadius; ++i) filterRow(i);
    for (int i = 0; i < m_area.height; ++i) {
      for (std::size_t plane = 0; plane < kPlanes; ++plane) filterColumns(i, plane);
      compareRow(maps.ssim.at(m_area.x, m_area.y + i), maps.structure.at(m_area.x, m_area.y + i));
    }
  }

private:
  float* rowOf(int i, std::size_t plane) {
    return m_rows.data() + (static_cast<std::size_t>(i) * kPlanes + plane) * m_width;
  }

  // Row area.y - radius + i, filtered along x.
  void filterRow(int i) {
    const int y = mirror(m_area.y - kRadius + i, m_reference.height);
    const float *a = m_reference.at(0, y), *b = m_test.at(0, y);
    float *s = m_in.data(), *d = s + m_padded, *ss = d + m_padded, *dd = ss + m_padded;
    const int left = m_area.x - kRadius, count = static_cast<int>(m_padded);
    const int begin = std::clamp(-left, 0, count), end = std::clamp(m_reference.width - left, begin, count);
    for (int k = begin; k < end; ++k) s[k] = a[left + k] + b[left + k] - 1.f, d[k] = a[left + k] - b[left + k];
    for (int k = 0; k < count; ++k) {
      if (k == begin) k = end;
      if (k >= count) break;
      const int x = mirror(left + k, m_reference.width);
      s[k] = a[x] + b[x] - 1.f, d[k] = a[x] - b[x];
    }
    for (int k = 0; k < count; ++k) ss[k] = s[k] * s[k], dd[k] = d[k] * d[k];
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      const float* in = m_in.data() + plane * m_padded + kRadius;
      float* __restrict out = rowOf(i, plane);
      const int n = m_area.width;
      for (int x = 0; x < n; ++x)
        out[x] = m_kernel[0] * in[x] + m_kernel[1] * (in[x - 1] + in[x + 1]) + m_kernel[2] * (in[x - 2] + in[x + 2]) +
                 m_kernel[3] * (in[x - 3] + in[x + 3]) + m_kernel[4] * (in[x - 4] + in[x + 4]) +
                 m_kernel[5] * (in[x - 5] + in[x + 5]);
    }
  }

  void filterColumns(int i, std::size_t plane) {
    const float* rows[2 * kRadius + 1];
    for (int k = 0; k <= 2 * kRadius; ++k) rows[k] = rowOf(i + k, plane);
    float* __restrict out = m_out.data() + plane * m_width;
    const int n = m_area.width;
    for (int x = 0; x < n; ++x)
      out[x] = m_kernel[0] * rows[5][x] + m_kernel[1] * (rows[4][x] + rows[6][x]) +
               m_kernel[2] * (rows[3][x] + rows[7][x]) + m_kernel[3] * (rows[2][x] + rows[8][x]) +
               m_kernel[4] * (rows[1][x] + rows[9][x]) + m_kernel[5] * (rows[0][x] + rows[10][x]);
  }

  // 2 mx my = (s^2 - d^2)/2, mx^2 + my^2 = (s^2 + d^2)/2, and the same of the variances of s and d.
  void compareRow(float* __restrict ssim, float* __restrict structure) const {
    const float *s = m_out.data(), *d = s + m_width, *ss = d + m_width, *dd = ss + m_width;
    const int n = m_area.width;
    for (int x = 0; x < n; ++x) {
      const float sum = s[x] + 1.f, s2 = sum * sum, d2 = d[x] * d[x];
      const float sumVariance = ss[x] - s[x] * s[x], differenceVariance = dd[x] - d2;
      const float vs = sumVariance > 0.f ? sumVariance : 0.f, vd = differenceVariance > 0.f ? differenceVariance : 0.f;
      const float cs = (0.5f * (vs - vd) + kC2) / (0.5f * (vs + vd) + kC2);
      structure[x] = cs;
      ssim[x] = cs * ((0.5f * (s2 - d2) + kC1) / (0.5f * (s2 + d2) + kC1));
    }
  }

  const base::Image &m_reference, &m_test;
  const Rect m_area;
  const std::array<float, kRadius + 1> m_kernel = makeKernel();
  std::size_t m_padded, m_width;
  std::vector<float> m_in, m_rows, m_out;
};

} // namespace

SsimMaps ssimMaps(const base::Image& reference, const base::Image& test, const Rect& box) {
  SsimMaps maps{base::Image(reference.width, reference.height, 1), base::Image(reference.width, reference.height, 1)};
  if (box.empty()) return maps;
  const int columns = (box.width + kTileWidth - 1) / kTileWidth, rows = (box.height + kTileHeight - 1) / kTileHeight;
  base::parallelFor(
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t) {
        const int tile = static_cast<int>(begin);
        const int x = tile % columns * kTileWidth, y = tile / columns * kTileHeight;
        Tile(reference, test,
             {box.x + x, box.y + y, std::min(kTileWidth, box.width - x), std::min(kTileHeight, box.height - y)})
            .run(maps);
      });
  return maps;
}

} // namespace parity::compare
