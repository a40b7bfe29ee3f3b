#include "compare/flip/flip_tile.h"

#include <algorithm>
#include <utility>

#include <hwy/cache_control.h>

#include "compare/flip/flip_buffer.h"

namespace parity::compare {
namespace {

constexpr int kResultPlanes = 3; // of Differences
constexpr int kRowStep = 4;

// Columns first..end-1 of row y.
void prefetchRow(const PixelView& image, int first, int end, int y) {
  constexpr std::ptrdiff_t kCacheLine = 64;
  const auto size = static_cast<std::ptrdiff_t>(image.floats ? sizeof(float) : sizeof(std::uint8_t));
  const auto* pixels = image.floats ? reinterpret_cast<const std::uint8_t*>(image.floats) : image.bytes;
  const std::uint8_t* row = pixels + size * y * image.stride;
  const std::ptrdiff_t last = size * end * image.channels - 1;
  for (std::ptrdiff_t at = size * first * image.channels; at < last; at += kCacheLine) hwy::Prefetch(row + at);
  hwy::Prefetch(row + last);
}

} // namespace

TileWorkspace::TileWorkspace(const FlipFilters& filters)
    : m_filters(filters), m_margin(roundUp(filters.radius, kAlignment)), m_ringRows(2 * filters.radius + kBatchRows),
      // An odd number of cache lines: rows a power of two apart would all fall into the same few sets of a cache.
      m_stride(
          static_cast<std::size_t>(roundUp(2 * m_margin + kTileWidth + kMaxSimdStep, 2 * kAlignment) + kAlignment)) {
  m_ring = allocate(kSourcePlanes * m_stride * static_cast<std::size_t>(m_ringRows));
  m_heldRow.assign(static_cast<std::size_t>(m_ringRows), -1);
  m_pointers.resize(static_cast<std::size_t>(m_ringRows));
  for (auto* planes : {&m_reference, &m_test}) *planes = allocate(kFilteredPlanes * kBatchRows * m_stride);
  m_chunk = allocate((2 * kFilteredPlaneCount + kResultPlanes) * kChunkValues + kMaxSimdStep);
  m_resultRows = allocate(kChunkValues);
}

std::uint64_t TileWorkspace::run(const TileJob& job, const RowDecoder& decoder, const Rect& box,
                                 const TileOutputs& out) {
  std::ranges::fill(m_heldRow, -1);
  const int radius = m_filters.radius;
  std::uint64_t filtered = 0;
  const int bottom = box.y + box.height;
  for (int y = box.y, rows = 0; y < bottom; y += rows) {
    // A batch begins near the first row that a difference reaches.
    rows = std::min(kRowStep, bottom - y);
    if (!job.differences->differs(box.x - radius, y - radius, box.x + box.width + radius, y + rows + radius)) continue;
    rows = std::min(kBatchRows, bottom - y);
    const auto isDirty = [&](int begin) {
      return job.differences->differs(box.x + begin - radius, y - radius,
                                      box.x + std::min(begin + kBlockWidth, box.width) + radius, y + rows + radius);
    };
    bool filled = false;
    for (int begin = 0; begin < box.width; begin += kBlockWidth) {
      if (!isDirty(begin)) continue;
      int end = begin + kBlockWidth;
      while (end < box.width && isDirty(end)) end += kBlockWidth;
      end = std::min(end, box.width);
      if (!filled) {
        fillWindow(job, decoder, box, y);
        filled = true;
      }
      runColumns(box, y, rows, begin, end, out);
      filtered += static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(end - begin);
      begin = roundUp(end, kBlockWidth) - kBlockWidth;
    }
  }
  return filtered;
}

int TileWorkspace::firstColumn(const Rect& box) const { return std::max(box.x - m_filters.radius, 0); }
int TileWorkspace::endColumn(const Rect& box, const PixelView& image) const {
  return std::min(box.x + box.width + m_filters.radius, image.width);
}

void TileWorkspace::fillWindow(const TileJob& job, const RowDecoder& decoder, const Rect& box, int y) {
  for (int i = 0; i < m_ringRows; ++i) {
    const int source = std::clamp(y - m_filters.radius + i, 0, job.reference.height - 1);
    const auto slot = static_cast<std::size_t>(source % m_ringRows);
    float* row = m_ring.get() + kSourcePlanes * m_stride * slot;
    m_pointers[static_cast<std::size_t>(i)] = row;
    if (m_heldRow[slot] == source) continue;
    m_heldRow[slot] = source;
    // Rows of a tile are short and far apart: the processor does not foresee the next one.
    if (source + 1 < job.reference.height)
      for (const PixelView* image : {&job.reference, &job.test})
        prefetchRow(*image, firstColumn(box), endColumn(box, *image), source + 1);
    const auto plane = [&](SourcePlane p) { return row + p * m_stride; };
    decodeInto({plane(kReferenceY), plane(kReferenceXMinusY), plane(kReferenceYMinusZ)}, job.reference, decoder, box,
               source);
    // The test's colours take the place of their differences for a moment.
    decodeInto({plane(kTestY), plane(kDifferenceXMinusY), plane(kDifferenceYMinusZ)}, job.test, decoder, box, source);
    subtractRow(plane(kReferenceY), plane(kTestY), m_stride, plane(kDifferenceY));
    subtractRow(plane(kReferenceXMinusY), plane(kDifferenceXMinusY), 2 * m_stride, plane(kDifferenceXMinusY));
  }
}

// Column x of the image is value m_margin + x - box.x of each plane; beyond the image's borders they are replicated.
void TileWorkspace::decodeInto(const ColorPlanes& planes, const PixelView& image, const RowDecoder& decoder,
                               const Rect& box, int y) {
  const int left = box.x - m_filters.radius, right = box.x + box.width + m_filters.radius;
  const int first = firstColumn(box), end = endColumn(box, image);
  const int at = m_margin + first - box.x, count = end - first;
  const ColorPlanes inside = {planes.y + at, planes.xMinusY + at, planes.yMinusZ + at};
  const std::ptrdiff_t offset = y * image.stride + static_cast<std::ptrdiff_t>(first) * image.channels;
  if (image.floats)
    decodeRow(decoder, image.floats + offset, image.channels, count, inside);
  else
    decodeRow(image.bytes + offset, image.channels, count, inside);
  for (float* plane : {inside.y, inside.xMinusY, inside.yMinusZ}) {
    std::fill(plane - (first - left), plane, plane[0]);
    std::fill(plane + count, plane + count + (right - end), plane[count - 1]);
  }
}

void TileWorkspace::writeColumns(const float* columns, int count, int rows, float* out, std::ptrdiff_t stride) {
  if (count == kChunkColumns && rows == kBatchRows) return rowsOfColumns(columns, count, rows, out, stride);
  rowsOfColumns(columns, count, rows, m_resultRows.get(), kChunkColumns);
  for (int r = 0; r < rows; ++r) std::copy_n(m_resultRows.get() + r * kChunkColumns, count, out + r * stride);
}

void TileWorkspace::runColumns(const Rect& box, int y, int rows, int begin, int end, const TileOutputs& out) {
  const int from = (m_margin + begin - m_filters.radius) / kAlignment * kAlignment;
  const int last = m_margin + end + m_filters.radius;
  filterAcrossRows(m_filters, kReferenceInput, m_pointers.data(), m_stride, from, last, rows, m_reference.get());
  filterAcrossRows(m_filters, kTestInput, m_pointers.data(), m_stride, from, last, rows, m_test.get());
  const FilteredColumns reference = filteredColumnsAt(m_chunk.get(), kChunkValues);
  const FilteredColumns test = filteredColumnsAt(m_chunk.get() + kFilteredPlaneCount * kChunkValues, kChunkValues);
  float* results = m_chunk.get() + 2 * kFilteredPlaneCount * kChunkValues;
  const Differences result = {results, out.color ? results + kChunkValues : nullptr,
                              out.feature ? results + 2 * kChunkValues : nullptr};
  const std::pair<float*, const float*> written[] = {
      {out.flip, result.flip}, {out.color, result.color}, {out.feature, result.feature}};
  for (int x = begin; x < end; x += kChunkColumns) {
    const int count = std::min(kChunkColumns, end - x);
    filterAlongRows(m_filters, m_reference.get(), m_stride, m_margin + x, count, rows, reference);
    filterAlongRows(m_filters, m_test.get(), m_stride, m_margin + x, count, rows, test);
    computeDifferences(reference, test, count * kBatchRows, result);
    for (const auto& [to, values] : written)
      if (to) writeColumns(values, count, rows, to + (y - box.y) * out.stride + x, out.stride);
  }
}

std::vector<Rect> tilesOf(const Rect& region) {
  std::vector<Rect> tiles;
  for (int y = 0; y < region.height; y += kTileHeight)
    for (int x = 0; x < region.width; x += kTileWidth)
      tiles.push_back({region.x + x, region.y + y, std::min(kTileWidth, region.width - x),
                       std::min(kTileHeight, region.height - y)});
  return tiles;
}

} // namespace parity::compare
