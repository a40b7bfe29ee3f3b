#include "compare/flip/difference_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip/flip_simd.h"

namespace parity::compare {
namespace {

constexpr std::size_t kRowsPerTask = 16;

std::ptrdiff_t offsetOf(const PixelView& view, const Rect& box, int row) {
  return (box.y + row) * view.stride + static_cast<std::ptrdiff_t>(box.x) * view.channels;
}

std::size_t valuesPerRow(const PixelView& view, const Rect& box) {
  return static_cast<std::size_t>(box.width) * static_cast<std::size_t>(view.channels);
}

[[noreturn]] void refuseNonFinite(const PixelView& view, const Rect& box, const char* name) {
  std::uint64_t count = 0;
  int firstX = 0, firstY = 0;
  for (int row = 0; row < box.height; ++row)
    for (int x = 0; x < box.width; ++x) {
      const float* pixel = view.floats + offsetOf(view, box, row) + static_cast<std::ptrdiff_t>(x) * view.channels;
      if (std::all_of(pixel, pixel + view.channels, [](float v) { return std::isfinite(v); })) continue;
      if (count++ == 0) firstX = box.x + x, firstY = box.y + row;
    }
  throw base::Error(base::ExitCode::failed, name, "x " + std::to_string(firstX) + ", y " + std::to_string(firstY),
                    std::to_string(count) + (count == 1 ? " pixel is" : " pixels are") +
                        " NaN or infinite, this is the first");
}

} // namespace

void requireFinite(const PixelView& view, const Rect& box, const char* name) {
  if (!view.floats) return;
  std::atomic<bool> finite{true};
  base::parallelFor(static_cast<std::size_t>(box.height), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      if (!allFinite(view.floats + offsetOf(view, box, static_cast<int>(row)), valuesPerRow(view, box))) finite = false;
  });
  if (!finite) refuseNonFinite(view, box, name);
}

DifferenceMap::DifferenceMap(const PixelView& reference, const PixelView& test, const Rect& box)
    : m_box(box), m_wordsPerRow((static_cast<std::size_t>(box.width) / kCellWidth + 64) / 64),
      m_bits(m_wordsPerRow * static_cast<std::size_t>(box.height), 0) {
  const std::size_t values = valuesPerRow(reference, box);
  std::atomic<bool> finiteReference{true}, finiteTest{true};
  base::parallelFor(static_cast<std::size_t>(box.height), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      std::uint64_t* bits = m_bits.data() + row * m_wordsPerRow;
      const int y = static_cast<int>(row);
      const auto cell = static_cast<std::size_t>(kCellWidth) * static_cast<std::size_t>(reference.channels);
      if (reference.floats) {
        const float *a = reference.floats + offsetOf(reference, box, y), *b = test.floats + offsetOf(test, box, y);
        markDifferences(a, b, values * sizeof(float), cell * sizeof(float), bits);
        if (!allFinite(a, values)) finiteReference = false;
        if (!allFinite(b, values)) finiteTest = false;
      } else {
        markDifferences(reference.bytes + offsetOf(reference, box, y), test.bytes + offsetOf(test, box, y), values,
                        cell, bits);
      }
    }
  });
  if (!finiteReference) refuseNonFinite(reference, box, "reference");
  if (!finiteTest) refuseNonFinite(test, box, "test");
}

bool DifferenceMap::differs(int x0, int y0, int x1, int y1) const {
  x0 = std::max(x0 - m_box.x, 0), x1 = std::min(x1 - m_box.x, m_box.width);
  y0 = std::max(y0 - m_box.y, 0), y1 = std::min(y1 - m_box.y, m_box.height);
  if (x0 >= x1) return false;
  const auto first = static_cast<std::size_t>(x0 / kCellWidth), last = static_cast<std::size_t>((x1 - 1) / kCellWidth);
  for (std::size_t word = first / 64; word <= last / 64; ++word) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (word == first / 64) mask &= ~std::uint64_t{0} << (first % 64);
    if (word == last / 64) mask &= ~std::uint64_t{0} >> (63 - last % 64);
    for (int y = y0; y < y1; ++y)
      if (m_bits[static_cast<std::size_t>(y) * m_wordsPerRow + word] & mask) return true;
  }
  return false;
}

} // namespace parity::compare
