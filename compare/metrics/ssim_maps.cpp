#include "compare/metrics/ssim_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"

// The inner loops are plain: the compiler makes vectors of them for each instruction set that Highway names.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/ssim_maps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

// k: the kernel's middle and five weights to one side.
void FilterAlong(const float* __restrict in, const float* k, int count, float* __restrict out) {
  const float k0 = k[0], k1 = k[1], k2 = k[2], k3 = k[3], k4 = k[4], k5 = k[5];
  for (int x = 0; x < count; ++x)
    out[x] = k0 * in[x] + k1 * (in[x - 1] + in[x + 1]) + k2 * (in[x - 2] + in[x + 2]) + k3 * (in[x - 3] + in[x + 3]) +
             k4 * (in[x - 4] + in[x + 4]) + k5 * (in[x - 5] + in[x + 5]);
}

// rows: eleven, the middle one is the sixth.
void FilterAcross(const float* const* rows, const float* k, int count, float* __restrict out) {
  const float k0 = k[0], k1 = k[1], k2 = k[2], k3 = k[3], k4 = k[4], k5 = k[5];
  const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5], *g = rows[6],
              *h = rows[7], *i = rows[8], *j = rows[9], *l = rows[10];
  for (int x = 0; x < count; ++x)
    out[x] = k0 * f[x] + k1 * (e[x] + g[x]) + k2 * (d[x] + h[x]) + k3 * (c[x] + i[x]) + k4 * (b[x] + j[x]) +
             k5 * (a[x] + l[x]);
}

// Of the filtered planes of compare/metrics/ssim_maps.cpp's order: 2 mx my = (s^2 - d^2)/2, mx^2 + my^2 = (s^2 +
// d^2)/2, and the same of the variances of s and d.
void CompareRow(const float* const* planes, int count, float* __restrict ssim, float* __restrict structure) {
  constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;
  const float *s = planes[0], *d = planes[1], *ss = planes[2], *dd = planes[3];
  for (int x = 0; x < count; ++x) {
    const float sum = s[x] + 1.f, s2 = sum * sum, d2 = d[x] * d[x];
    const float sumVariance = ss[x] - s[x] * s[x], differenceVariance = dd[x] - d2;
    const float vs = sumVariance > 0.f ? sumVariance : 0.f, vd = differenceVariance > 0.f ? differenceVariance : 0.f;
    const float cs = (0.5f * (vs - vd) + kC2) / (0.5f * (vs + vd) + kC2);
    structure[x] = cs;
    ssim[x] = cs * ((0.5f * (s2 - d2) + kC1) / (0.5f * (s2 + d2) + kC1));
  }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {
namespace {

HWY_EXPORT(FilterAlong);
HWY_EXPORT(FilterAcross);
HWY_EXPORT(CompareRow);

constexpr int kRadius = 5;
// A task's tile: the filtered rows of it stay in the second-level cache.
constexpr int kTileWidth = 192, kTileHeight = 64;

// Of the sums s = x + y - 1 and differences d = x - y, and of their squares: from these all moments follow. d is
// exactly 0 where the images are identical, and s about 0 for mid-greys, so that less cancels in its variance.
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
      HWY_DYNAMIC_DISPATCH(FilterAlong)
      (m_in.data() + plane * m_padded + kRadius, m_kernel.data(), m_area.width, rowOf(i, plane));
    }
  }

  void filterColumns(int i, std::size_t plane) {
    const float* rows[2 * kRadius + 1];
    for (int k = 0; k <= 2 * kRadius; ++k) rows[k] = rowOf(i + k, plane);
    HWY_DYNAMIC_DISPATCH(FilterAcross)(rows, m_kernel.data(), m_area.width, m_out.data() + plane * m_width);
  }

  void compareRow(float* ssim, float* structure) const {
    const float* planes[kPlanes];
    for (std::size_t plane = 0; plane < kPlanes; ++plane) planes[plane] = m_out.data() + plane * m_width;
    HWY_DYNAMIC_DISPATCH(CompareRow)(planes, m_area.width, ssim, structure);
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
#endif
