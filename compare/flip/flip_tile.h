// FLIP of one tile of an image: decoding, filters and differences over a window of rows that stays in the cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "compare/flip/difference_map.h"
#include "compare/flip/flip_simd.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// A tile is one task. Fixed, so that no result depends on the number of threads. The width: both images' windows of
// rows stay in the second-level cache, the margins that neighbours both decode are a small part, and it divides the
// usual widths of pictures.
inline constexpr int kTileWidth = 320, kTileHeight = 256;

// Where a tile's results go: its first pixel, and how far apart rows are. color and feature may be null.
struct TileOutputs {
  float *flip, *color, *feature;
  std::ptrdiff_t stride;
};

// All that is the same for every tile of a pair.
struct TileJob {
  PixelView reference, test; // 3 or 4 channels, of equal size and type
  const FlipFilters* filters;
  const DifferenceMap* differences;
};

// The memory that a tile is worked on in; reused from tile to tile.
class TileWorkspace {
public:
  explicit TileWorkspace(const FlipFilters& filters);

  // Writes the results of the box (at most a tile) and returns how many of its pixels had to be filtered; those further
  // than the filters' radius from any difference are 0 and are not touched: outputs must come zeroed.
  std::uint64_t run(const TileJob& job, const RowDecoder& decoder, const Rect& box, const TileOutputs& out);

private:
  // The columns of an image that a box needs.
  int firstColumn(const Rect& box) const;
  int endColumn(const Rect& box, const PixelView& image) const;
  void fillWindow(const TileJob& job, const RowDecoder& decoder, const Rect& box, int y);
  void decodeInto(const ColorPlanes& planes, const PixelView& image, const RowDecoder& decoder, const Rect& box, int y);
  void runColumns(const Rect& box, int y, int rows, int begin, int end, const TileOutputs& out);
  void writeColumns(const float* columns, int count, int rows, float* out, std::ptrdiff_t stride);

  const FlipFilters& m_filters;
  int m_margin;         // columns left of the tile in each row: the radius, rounded up so that columns stay aligned
  int m_ringRows;       // rows of a batch's window
  std::size_t m_stride; // values of one row of one plane
  // Rows are decoded once, when first needed, and kept in a ring of slots: kSourcePlanes planes each.
  hwy::AlignedFreeUniquePtr<float[]> m_ring;
  std::vector<int> m_heldRow;                             // which row of the image each slot holds; -1: none
  std::vector<const float*> m_pointers;                   // to the rows of the batch's window, from the topmost
  hwy::AlignedFreeUniquePtr<float[]> m_reference, m_test; // planes of the batch, filtered across rows
  hwy::AlignedFreeUniquePtr<float[]> m_chunk;             // filtered columns of both images, and the results
  hwy::AlignedFreeUniquePtr<float[]> m_resultRows;        // of a chunk that the tile's end cuts
};

// Hands out workspaces to threads, and takes them back: as many are made as are in use at once.
template <typename Workspace> class WorkspacePool {
public:
  explicit WorkspacePool(std::function<std::unique_ptr<Workspace>()> make) : m_make(std::move(make)) {}
  std::unique_ptr<Workspace> take() {
    {
      const std::lock_guard lock(m_mutex);
      if (!m_free.empty()) {
        auto workspace = std::move(m_free.back());
        m_free.pop_back();
        return workspace;
      }
    }
    return m_make();
  }
  void giveBack(std::unique_ptr<Workspace> workspace) {
    const std::lock_guard lock(m_mutex);
    m_free.push_back(std::move(workspace));
  }

private:
  std::function<std::unique_ptr<Workspace>()> m_make;
  std::mutex m_mutex;
  std::vector<std::unique_ptr<Workspace>> m_free;
};

// The boxes of a region of at most a tile each.
std::vector<Rect> tilesOf(const Rect& region);

} // namespace parity::compare
