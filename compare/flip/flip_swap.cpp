// By tiles, as flip_tile.cpp: the reference's filtered values are kept for the tile, and each swap filters only its own
// difference from the reference, which is 0 but at its pixels.
#include "compare/flip/flip_swap.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

#include <hwy/aligned_allocator.h>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip/difference_map.h"
#include "compare/flip/flip_buffer.h"
#include "compare/flip/flip_run.h"
#include "compare/flip/swap_index.h"

namespace parity::compare {
namespace {

constexpr int kReferencePlanes = 3;
constexpr int kBatches = kTileHeight / kBatchRows;
static_assert(kTileWidth / kBlockWidth <= 32, "32 bits hold one for each block of a row");

std::size_t sizeOf(const PixelView& view) { return view.floats ? sizeof(float) : sizeof(std::uint8_t); }
const std::uint8_t* bytesOf(const PixelView& view) {
  return view.floats ? reinterpret_cast<const std::uint8_t*>(view.floats) : view.bytes;
}

class SwapTile {
public:
  SwapTile(const PixelView& reference, const FlipFilters& filters, const RowDecoder& decoder)
      : m_reference(reference), m_filters(filters), m_decoder(decoder), m_radius(filters.radius),
        m_margin(roundUp(m_radius, kAlignment)), m_ringRows(2 * m_radius + kBatchRows),
        m_windowRows(kTileHeight + 2 * m_radius), m_pixelBytes(sizeOf(reference) * reference.channels),
        m_stride(
            static_cast<std::size_t>(roundUp(2 * m_margin + kTileWidth + kMaxSimdStep, 2 * kAlignment) + kAlignment)) {
    m_referenceRows = allocate(kReferencePlanes * m_stride * static_cast<std::size_t>(m_windowRows));
    m_ring = allocate(kSourcePlanes * m_stride * static_cast<std::size_t>(m_ringRows));
    m_batch = allocate(kFilteredPlanes * kBatchRows * m_stride);
    m_kept = allocate(kFilteredPlaneCount * kKeptValues * kBatches);
    m_scratch = allocate((2 * kFilteredPlaneCount + 1) * kChunkValues + kMaxSimdStep);
    m_pointers.resize(static_cast<std::size_t>(m_ringRows));
    m_colors.resize(m_pixelBytes * static_cast<std::size_t>(kTileWidth + 2 * m_radius));
  }

  // Writes the values of the swaps' pixels that lie in the box (at most a tile); those that nothing reaches are left.
  void run(const Rect& box, std::span<const SwapIndex> swaps, std::vector<std::vector<float>>& values) {
    m_box = box;
    std::vector<std::pair<std::size_t, Blocks>> dirty;
    Blocks any{};
    for (std::size_t s = 0; s < swaps.size(); ++s) {
      const Blocks blocks = findBlocks(swaps[s]);
      if (std::ranges::all_of(blocks, [](std::uint32_t b) { return b == 0; })) continue;
      dirty.emplace_back(s, blocks);
      for (std::size_t i = 0; i < any.size(); ++i) any[i] |= blocks[i];
    }
    if (dirty.empty()) return;
    filterReference(any);
    for (const auto& [s, blocks] : dirty) filterSwap(swaps[s], blocks, values[s]);
  }

private:
  static constexpr std::size_t kKeptValues = kTileWidth * kBatchRows; // of a plane of a batch
  // Of each batch of rows the blocks of columns that are filtered, a bit each.
  using Blocks = std::array<std::uint32_t, kBatches>;

  const std::uint8_t* referenceAt(int x, int y) const {
    return bytesOf(m_reference) + sizeOf(m_reference) * static_cast<std::size_t>(y * m_reference.stride) +
           m_pixelBytes * static_cast<std::size_t>(x);
  }
  const std::uint8_t* colorAt(const SwapIndex& indexed, std::uint32_t place) const {
    return bytesOf(indexed.swap().colors) + m_pixelBytes * place;
  }
  int left() const { return std::max(m_box.x - m_radius, 0); }
  int right() const { return std::min(m_box.x + m_box.width + m_radius, m_reference.width); }

  // The blocks that hold pixels of the swap and that a difference reaches.
  Blocks findBlocks(const SwapIndex& indexed) const {
    Blocks present{}, blocks{};
    if (!indexed.touches(m_box)) return blocks; // none of its pixels
    std::vector<std::uint32_t> reached(static_cast<std::size_t>(m_box.height + 2 * m_radius), 0);
    bool any = false;
    for (int i = 0; i < m_box.height + 2 * m_radius; ++i) {
      const int y = m_box.y - m_radius + i;
      if (y < 0 || y >= m_reference.height) continue;
      const auto [from, to] = indexed.placesOf(y, left(), right());
      const bool inside = y >= m_box.y && y < m_box.y + m_box.height;
      for (std::uint32_t place = from; place < to; ++place) {
        const int x = indexed.columnOf(place) - m_box.x;
        if (inside && x >= 0 && x < m_box.width)
          present[static_cast<std::size_t>((y - m_box.y) / kBatchRows)] |= 1u << (x / kBlockWidth);
        if (std::memcmp(referenceAt(x + m_box.x, y), colorAt(indexed, place), m_pixelBytes) == 0) continue;
        any = true;
        const int first = std::max(x - m_radius, 0) / kBlockWidth,
                  last = std::min(x + m_radius, m_box.width - 1) / kBlockWidth;
        for (int b = first; b <= last; ++b) reached[static_cast<std::size_t>(i)] |= 1u << b;
      }
    }
    if (!any) return blocks;
    for (int batch = 0; batch * kBatchRows < m_box.height; ++batch) {
      std::uint32_t mask = 0;
      const int begin = batch * kBatchRows,
                end = std::min(begin + kBatchRows, m_box.height) + 2 * m_radius; // places in `reached`
      for (int i = begin; i < end; ++i) mask |= reached[static_cast<std::size_t>(i)];
      blocks[static_cast<std::size_t>(batch)] = mask & present[static_cast<std::size_t>(batch)];
    }
    return blocks;
  }

  // Calls act(begin, end) for each run of columns whose blocks are set.
  template <typename Act> void forColumns(std::uint32_t blocks, const Act& act) const {
    const int count = (m_box.width + kBlockWidth - 1) / kBlockWidth;
    for (int b = 0; b < count; ++b) {
      if ((blocks >> b & 1) == 0) continue;
      const int begin = b;
      while (b + 1 < count && (blocks >> (b + 1) & 1) != 0) ++b;
      act(begin * kBlockWidth, std::min((b + 1) * kBlockWidth, m_box.width));
    }
  }

  // Decodes a row of pixels (columns left()..right()-1) into three planes that begin at the window's first column, and
  // replicates it beyond the image's borders.
  void decode(const std::uint8_t* pixels, float* y, float* xMinusY, float* yMinusZ) const {
    const int at = m_margin + left() - m_box.x, count = right() - left();
    const ColorPlanes inside = {y + at, xMinusY + at, yMinusZ + at};
    if (m_reference.floats)
      decodeRow(m_decoder, reinterpret_cast<const float*>(pixels), m_reference.channels, count, inside);
    else
      decodeRow(pixels, m_reference.channels, count, inside);
    const int before = left() - (m_box.x - m_radius), after = m_box.x + m_box.width + m_radius - right();
    for (float* plane : {inside.y, inside.xMinusY, inside.yMinusZ}) {
      std::fill(plane - before, plane, plane[0]);
      std::fill(plane + count, plane + count + after, plane[count - 1]);
    }
  }

  // Row i of the window, y = box.y - radius + i.
  float* referenceRow(int i) const {
    return m_referenceRows.get() + kReferencePlanes * m_stride * static_cast<std::size_t>(i);
  }
  int imageRowOf(int i) const { return std::clamp(m_box.y - m_radius + i, 0, m_reference.height - 1); }

  // The reference's filtered columns of a batch from column `begin` on, as they are kept.
  FilteredColumns keptColumns(int batch, int begin) const {
    float* at = m_kept.get() + kFilteredPlaneCount * kKeptValues * static_cast<std::size_t>(batch);
    return filteredColumnsAt(at + static_cast<std::ptrdiff_t>(begin) * kBatchRows, kKeptValues);
  }
  FilteredColumns scratchColumns(std::size_t index) const {
    return filteredColumnsAt(m_scratch.get() + index * kFilteredPlaneCount * kChunkValues, kChunkValues);
  }

  void filterAcross(const FilterInput& input, int begin, int end, int rows) {
    const int from = (m_margin + begin - m_radius) / kAlignment * kAlignment, last = m_margin + end + m_radius;
    filterAcrossRows(m_filters, input, m_pointers.data(), m_stride, from, last, rows, m_batch.get());
  }

  void filterReference(const Blocks& any) {
    std::vector<char> decoded(static_cast<std::size_t>(m_windowRows), 0);
    for (int batch = 0; batch * kBatchRows < m_box.height; ++batch) {
      const std::uint32_t blocks = any[static_cast<std::size_t>(batch)];
      if (blocks == 0) continue;
      const int y = batch * kBatchRows, rows = std::min(kBatchRows, m_box.height - y);
      for (int i = 0; i < m_ringRows; ++i) {
        const int at = std::min(y + i, m_box.height + 2 * m_radius - 1); // the last batch may be shorter
        float* row = referenceRow(at);
        m_pointers[static_cast<std::size_t>(i)] = row;
        if (decoded[static_cast<std::size_t>(at)] != 0) continue;
        decoded[static_cast<std::size_t>(at)] = 1;
        decode(referenceAt(left(), imageRowOf(at)), row, row + m_stride, row + 2 * m_stride);
      }
      forColumns(blocks, [&](int begin, int end) {
        filterAcross(kReferenceInput, begin, end, rows);
        // Runs are written from the left to the right: what one overruns is written by the next, or is not read.
        filterAlongRows(m_filters, m_batch.get(), m_stride, m_margin + begin, end - begin, rows,
                        keptColumns(batch, begin));
      });
    }
  }

  // The swapped picture's row: its difference from the reference, and its Y.
  void fillSwappedRow(const SwapIndex& indexed, int i, float* row) {
    const auto plane = [&](SourcePlane p) { return row + p * m_stride; };
    const float* reference = referenceRow(i);
    const int y = imageRowOf(i);
    const auto [from, to] = indexed.placesOf(y, left(), right());
    if (from == to) {
      std::fill_n(plane(kDifferenceY), 3 * m_stride, 0.f);
      std::copy_n(reference, m_stride, plane(kTestY));
      return;
    }
    std::memcpy(m_colors.data(), referenceAt(left(), y), m_pixelBytes * static_cast<std::size_t>(right() - left()));
    for (std::uint32_t place = from; place < to; ++place)
      std::memcpy(m_colors.data() + m_pixelBytes * static_cast<std::size_t>(indexed.columnOf(place) - left()),
                  colorAt(indexed, place), m_pixelBytes);
    // The colours take the place of their differences for a moment.
    decode(m_colors.data(), plane(kTestY), plane(kDifferenceXMinusY), plane(kDifferenceYMinusZ));
    subtractRow(reference, plane(kTestY), m_stride, plane(kDifferenceY));
    subtractRow(reference + m_stride, plane(kDifferenceXMinusY), 2 * m_stride, plane(kDifferenceXMinusY));
  }

  void filterSwap(const SwapIndex& indexed, const Blocks& blocks, std::vector<float>& values) {
    std::vector<int> held(static_cast<std::size_t>(m_ringRows), -1);
    for (int batch = 0; batch * kBatchRows < m_box.height; ++batch) {
      if (blocks[static_cast<std::size_t>(batch)] == 0) continue;
      const int y = batch * kBatchRows, rows = std::min(kBatchRows, m_box.height - y);
      for (int i = 0; i < m_ringRows; ++i) {
        const int at = std::min(y + i, m_box.height + 2 * m_radius - 1);
        const auto slot = static_cast<std::size_t>(at % m_ringRows);
        float* row = m_ring.get() + kSourcePlanes * m_stride * slot;
        m_pointers[static_cast<std::size_t>(i)] = row;
        if (held[slot] == at) continue;
        held[slot] = at;
        fillSwappedRow(indexed, at, row);
      }
      forColumns(blocks[static_cast<std::size_t>(batch)], [&](int begin, int end) {
        filterAcross(kTestInput, begin, end, rows);
        for (int x = begin; x < end; x += kChunkColumns)
          compareColumns(indexed, batch, rows, x, std::min(kChunkColumns, end - x), values);
      });
    }
  }

  void compareColumns(const SwapIndex& indexed, int batch, int rows, int begin, int count, std::vector<float>& values) {
    std::array<std::pair<std::uint32_t, std::uint32_t>, kBatchRows> places;
    bool any = false;
    for (int r = 0; r < rows; ++r) {
      const auto [from, to] = places[static_cast<std::size_t>(r)] =
          indexed.placesOf(m_box.y + batch * kBatchRows + r, m_box.x + begin, m_box.x + begin + count);
      any |= from != to;
    }
    if (!any) return;
    // Comparing overwrites the colours.
    const FilteredColumns kept = keptColumns(batch, begin), colors = scratchColumns(0), test = scratchColumns(1);
    const FilteredColumns reference = {colors.y, colors.xMinusY, colors.yMinusZ, kept.edge2, kept.point2};
    const int size = count * kBatchRows;
    std::copy_n(kept.y, size, reference.y);
    std::copy_n(kept.xMinusY, size, reference.xMinusY);
    std::copy_n(kept.yMinusZ, size, reference.yMinusZ);
    filterAlongRows(m_filters, m_batch.get(), m_stride, m_margin + begin, count, rows, test);
    float* flip = m_scratch.get() + 2 * kFilteredPlaneCount * kChunkValues;
    computeDifferences(reference, test, size, {flip, nullptr, nullptr});
    for (int r = 0; r < rows; ++r)
      for (auto [place, end] = places[static_cast<std::size_t>(r)]; place < end; ++place)
        values[place] = flip[(indexed.columnOf(place) - m_box.x - begin) * kBatchRows + r];
  }

  const PixelView& m_reference;
  const FlipFilters& m_filters;
  const RowDecoder& m_decoder;
  int m_radius, m_margin; // columns left of the tile in each row: the radius, rounded up so that columns stay aligned
  int m_ringRows, m_windowRows;
  std::size_t m_pixelBytes, m_stride; // stride: values of one row of one plane
  Rect m_box;
  FlipBuffer m_referenceRows; // the tile's and its margin's rows, decoded
  FlipBuffer m_ring;          // rows of a swap, kSourcePlanes planes each
  FlipBuffer m_batch;         // planes of a batch, filtered across rows
  FlipBuffer m_kept;          // the reference's filtered columns
  FlipBuffer m_scratch;
  std::vector<const float*> m_pointers; // to the rows of the batch's window, from the topmost
  std::vector<std::uint8_t> m_colors;   // a row of a swapped picture
};

void requireFitting(const PixelView& reference, const FlipSwap& swap) {
  if (swap.pixels.empty()) return;
  const std::size_t places = static_cast<std::size_t>(swap.colors.width) * static_cast<std::size_t>(swap.colors.height);
  if (swap.colors.channels != reference.channels || !swap.colors.floats != !reference.floats ||
      places < swap.pixels.size() || swap.colors.stride != swap.colors.width * swap.colors.channels)
    throw base::Error(base::ExitCode::notComparable, "swapped colours", "", "are not gathered as the reference is");
  const std::size_t pixels = static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height);
  if (swap.pixels.back() >= pixels || !std::ranges::is_sorted(swap.pixels))
    throw base::Error(base::ExitCode::failed, "swapped colours", "", "of pixels outside the image or out of order");
  requireFinite(swap.colors, {0, 0, swap.colors.width, swap.colors.height}, "swapped colours");
}

} // namespace

std::vector<std::vector<float>> flipSwaps(const PixelView& reference, std::span<const FlipSwap> swaps, float ppd,
                                          const RowDecoder& decoder) {
  requireUsablePpd(ppd);
  requireComparableViews(reference, reference);
  const Rect whole = {0, 0, reference.width, reference.height};
  requireFinite(reference, whole, "reference");
  std::vector<std::vector<float>> values(swaps.size());
  std::vector<SwapIndex> indexed(swaps.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t s, std::size_t) {
    requireFitting(reference, swaps[s]);
    indexed[s] = SwapIndex(swaps[s], reference.width, reference.height);
    values[s].assign(swaps[s].pixels.size(), 0.f);
  });
  const FlipFilters filters = makeFlipFilters(ppd);
  const std::vector<Rect> tiles = tilesOf(whole);
  WorkspacePool<SwapTile> workspaces([&] { return std::make_unique<SwapTile>(reference, filters, decoder); });
  base::parallelFor(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    auto workspace = workspaces.take();
    for (std::size_t i = begin; i < end; ++i) workspace->run(tiles[i], indexed, values);
    workspaces.giveBack(std::move(workspace));
  });
  return values;
}

} // namespace parity::compare
