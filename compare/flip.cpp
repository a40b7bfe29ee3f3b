#include "compare/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip_color.h"
#include "compare/flip_filters.h"
#include "compare/flip_rows.h"
#include "compare/metrics.h"

namespace parity::compare {
namespace {

// A tile is one task: the windows of both images (2*radius+1 rows of this width) stay in the second-level cache, and
// the margins that tiles decode twice are a small part. Fixed, so that the result depends on no thread count.
constexpr int kTileWidth = 256, kTileHeight = 256;

void requireUsable(const FlipOptions& options) {
  if (!(options.ppd >= kMinPixelsPerDegree && options.ppd <= kMaxPixelsPerDegree))
    throw base::Error(base::ExitCode::usage, "ppd", std::to_string(options.ppd),
                      "pixels per degree must be between 1 and 1000");
}

// One image under a tile: decodes each row it needs once and keeps a window of them, replicated at the image's borders.
class SlidingWindow {
public:
  SlidingWindow(const base::Image& image, const RowDecoder& decoder, const FlipFilters& filters, int x0, int width)
      : m_image(image), m_decoder(decoder), m_filter(filters, width), m_radius(filters.radius), m_x0(x0),
        m_width(width), m_stride(static_cast<std::size_t>(paddedRow(width, m_radius))), m_rowCount(2 * m_radius + 1),
        m_planes(3 * m_stride * static_cast<std::size_t>(m_rowCount)) {
    for (auto* rows : {&m_y, &m_cx, &m_cz}) rows->resize(static_cast<std::size_t>(m_rowCount));
  }

  // Rows must be asked for from the top down, without gaps. The result holds until the next call.
  const FilteredRow& filterRow(int y) {
    const int last = std::min(y + m_radius, m_image.height - 1);
    if (m_next < 0) m_next = std::max(0, y - m_radius);
    for (; m_next <= last; ++m_next) decodeRow(m_next);
    for (int i = 0; i < m_rowCount; ++i) {
      const float* row = rowOf(std::clamp(y - m_radius + i, 0, m_image.height - 1));
      const auto k = static_cast<std::size_t>(i);
      m_y[k] = row, m_cx[k] = row + m_stride, m_cz[k] = row + 2 * m_stride;
    }
    return m_filter.apply(m_y.data(), m_cx.data(), m_cz.data());
  }

private:
  float* rowOf(int y) { return m_planes.data() + 3 * m_stride * static_cast<std::size_t>(y % m_rowCount); }

  void decodeRow(int y) {
    // Columns x0-radius .. x0+width+radius; the image has those from `first` to `end`.
    const int left = m_x0 - m_radius, right = m_x0 + m_width + m_radius;
    const int first = std::max(0, left), end = std::min(m_image.width, right);
    float* row = rowOf(y);
    float* inside = row + (first - left);
    m_decoder.decode(m_image.at(first, y), end - first, inside, inside + m_stride, inside + 2 * m_stride);
    for (float* plane : {row, row + m_stride, row + 2 * m_stride}) {
      std::fill(plane, plane + (first - left), plane[first - left]);
      std::fill(plane + (end - left), plane + m_stride, plane[end - left - 1]);
    }
  }

  const base::Image& m_image;
  const RowDecoder& m_decoder;
  RowFilter m_filter;
  int m_radius, m_x0, m_width;
  std::size_t m_stride;
  int m_rowCount;
  int m_next = -1; // the next row to decode
  std::vector<float> m_planes;
  std::vector<const float*> m_y, m_cx, m_cz;
};

// The images to write to; color and feature may be null.
struct Outputs {
  base::Image *flip, *color, *feature;
};

struct Job {
  const base::Image &reference, &test;
  const FlipFilters& filters;
  const RowDecoder& decoder;
  Outputs out;
};

void runTile(const Job& job, int x0, int y0) {
  const int width = std::min(kTileWidth, job.reference.width - x0);
  const int y1 = std::min(y0 + kTileHeight, job.reference.height);
  SlidingWindow reference(job.reference, job.decoder, job.filters, x0, width);
  SlidingWindow test(job.test, job.decoder, job.filters, x0, width);
  std::vector<float> color(static_cast<std::size_t>(width)), feature(color.size());
  for (int y = y0; y < y1; ++y) {
    const FilteredRow &a = reference.filterRow(y), &b = test.filterRow(y);
    colorDifferenceRow({a.y.data(), a.cx.data(), a.cz.data()}, {b.y.data(), b.cx.data(), b.cz.data()}, width,
                       color.data());
    featureDifferenceRow({a.edge.data(), a.point.data()}, {b.edge.data(), b.point.data()}, width, feature.data());
    combineRow(color.data(), feature.data(), width, job.out.flip->at(x0, y));
    if (job.out.color) std::copy(color.begin(), color.end(), job.out.color->at(x0, y));
    if (job.out.feature) std::copy(feature.begin(), feature.end(), job.out.feature->at(x0, y));
  }
}

void run(const base::Image& reference, const base::Image& test, const FlipOptions& options, const Outputs& out) {
  requireUsable(options);
  requireComparable(reference, test);
  if (reference.channels != 3)
    throw base::Error(base::ExitCode::notComparable, "FLIP", "",
                      "needs images of 3 channels, not " + std::to_string(reference.channels));
  requireFinite(reference, "reference");
  requireFinite(test, "test");

  for (base::Image* image : {out.flip, out.color, out.feature})
    if (image) *image = base::Image(reference.width, reference.height, 1);
  const FlipFilters filters = makeFlipFilters(options.ppd);
  // One way of decoding for both: equal pixels must stay equal to the last bit.
  const RowDecoder decoder(isEightBit(reference) && isEightBit(test));
  const Job job{reference, test, filters, decoder, out};
  const int columns = (reference.width + kTileWidth - 1) / kTileWidth;
  const int rows = (reference.height + kTileHeight - 1) / kTileHeight;
  base::parallelFor(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1,
                    [&](std::size_t begin, std::size_t) {
                      const int tile = static_cast<int>(begin);
                      runTile(job, tile % columns * kTileWidth, tile / columns * kTileHeight);
                    });
}

} // namespace

float pixelsPerDegree(float distance, float resolutionX, float width) {
  for (float value : {distance, resolutionX, width})
    if (!(std::isfinite(value) && value > 0))
      throw base::Error(base::ExitCode::usage, "viewing conditions", std::to_string(value),
                        "distance, resolution and width must be positive");
  return static_cast<float>(static_cast<double>(distance) * static_cast<double>(resolutionX) /
                            static_cast<double>(width) * (std::numbers::pi / 180));
}

int flipFilterRadius(const FlipOptions& options) {
  requireUsable(options);
  return colorFilterRadius(options.ppd);
}

base::Image flipMap(const base::Image& reference, const base::Image& test, const FlipOptions& options) {
  base::Image flip;
  run(reference, test, options, {&flip, nullptr, nullptr});
  return flip;
}

FlipMaps flipMaps(const base::Image& reference, const base::Image& test, const FlipOptions& options) {
  FlipMaps maps;
  run(reference, test, options, {&maps.flip, &maps.color, &maps.feature});
  return maps;
}

} // namespace parity::compare
