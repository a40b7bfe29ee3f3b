// The row filters of PNG. All bytes of a pixel at once: each pixel needs its left neighbour, so that no more can be.
#include "base/image/png_filter.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace parity::base {

namespace {

// Eight lanes of 16 bits, of which the first N are used. Vectors of the compiler: SSE2 and Neon have them.
using Lanes = std::int16_t __attribute__((vector_size(16)));
using ByteLanes = std::uint8_t __attribute__((vector_size(8)));
static_assert(std::endian::native == std::endian::little); // the lowest byte of a register is the first lane

std::uint16_t loadTwo(const std::uint8_t* bytes) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes, 2);
  return value;
}
std::uint32_t loadFour(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, 4);
  return value;
}

// Through a register: a vector that is read from where its bytes were just written one by one would wait for them.
template <int N> Lanes load(const std::uint8_t* bytes) {
  std::uint64_t packed = 0;
  if constexpr (N == 8) std::memcpy(&packed, bytes, 8);
  if constexpr (N == 4 || N == 6) packed = loadFour(bytes);
  if constexpr (N == 2 || N == 3) packed = loadTwo(bytes);
  if constexpr (N == 1) packed = bytes[0];
  if constexpr (N == 3) packed |= std::uint64_t{bytes[2]} << 16;
  if constexpr (N == 6) packed |= std::uint64_t{loadTwo(bytes + 4)} << 32;
  return __builtin_convertvector(std::bit_cast<ByteLanes>(packed), Lanes);
}

// Modulo 256.
template <int N> void store(Lanes lanes, std::uint8_t* bytes) {
  const auto packed = std::bit_cast<std::uint64_t>(__builtin_convertvector(lanes & 255, ByteLanes));
  const auto low = static_cast<std::uint32_t>(packed);
  if constexpr (N == 8) std::memcpy(bytes, &packed, 8);
  if constexpr (N == 4 || N == 6) std::memcpy(bytes, &low, 4);
  if constexpr (N == 2 || N == 3) std::memcpy(bytes, &low, 2);
  if constexpr (N == 1) bytes[0] = static_cast<std::uint8_t>(low);
  if constexpr (N == 3) bytes[2] = static_cast<std::uint8_t>(low >> 16);
  if constexpr (N == 6) {
    const auto high = static_cast<std::uint16_t>(packed >> 32);
    std::memcpy(bytes + 4, &high, 2);
  }
}

Lanes absolute(Lanes v) {
  const Lanes sign = v >> 15;
  return (v ^ sign) - sign;
}

Lanes choose(Lanes mask, Lanes yes, Lanes no) { return (mask & yes) | (~mask & no); }

template <int N> void undoSub(std::uint8_t* row, std::size_t size) {
  Lanes left{};
  for (std::size_t i = 0; i + N <= size; i += N) {
    left = (left + load<N>(row + i)) & 255;
    store<N>(left, row + i);
  }
}

void undoUp(std::uint8_t* row, const std::uint8_t* above, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
}

template <int N> void undoAverage(std::uint8_t* row, const std::uint8_t* above, std::size_t size) {
  Lanes left{};
  for (std::size_t i = 0; i + N <= size; i += N) {
    left = (load<N>(row + i) + ((left + load<N>(above + i)) >> 1)) & 255;
    store<N>(left, row + i);
  }
}

// The neighbour that is nearest to left + up - corner; of equals left, then up.
Lanes predict(Lanes left, Lanes up, Lanes corner) {
  const Lanes byUp = up - corner, byLeft = left - corner;
  const Lanes toLeft = absolute(byUp), toUp = absolute(byLeft), toCorner = absolute(byUp + byLeft);
  const Lanes isUp = toUp <= toCorner, isLeft = (toLeft <= toUp) & (toLeft <= toCorner);
  return choose(isLeft, left, choose(isUp, up, corner));
}

template <int N> void undoPaeth(std::uint8_t* row, const std::uint8_t* above, std::size_t size) {
  Lanes left{}, corner{};
  for (std::size_t i = 0; i + N <= size; i += N) {
    const Lanes up = load<N>(above + i);
    left = (load<N>(row + i) + predict(left, up, corner)) & 255;
    corner = up;
    store<N>(left, row + i);
  }
}

template <int N> void undo(PngFilter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t size) {
  switch (filter) {
  case PngFilter::none:
    return;
  case PngFilter::sub:
    return undoSub<N>(row, size);
  case PngFilter::up:
    return undoUp(row, above, size);
  case PngFilter::average:
    return undoAverage<N>(row, above, size);
  case PngFilter::paeth:
    return undoPaeth<N>(row, above, size);
  }
}

} // namespace

void filterByPaeth(const std::uint8_t* row, const std::uint8_t* above, std::size_t size, int pixelBytes,
                   std::uint8_t* out) {
  const auto pixel = std::min(static_cast<std::size_t>(pixelBytes), size);
  std::size_t i = 0;
  for (; i < pixel; ++i) out[i] = static_cast<std::uint8_t>(row[i] - above[i]); // nothing is left of it
  for (; i + 8 <= size; i += 8)
    store<8>(load<8>(row + i) - predict(load<8>(row + i - pixel), load<8>(above + i), load<8>(above + i - pixel)),
             out + i);
  for (; i < size; ++i)
    store<1>(load<1>(row + i) - predict(load<1>(row + i - pixel), load<1>(above + i), load<1>(above + i - pixel)),
             out + i);
}

void unfilterRow(PngFilter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t size, int pixelBytes) {
  switch (pixelBytes) {
  case 1:
    return undo<1>(filter, row, above, size);
  case 2:
    return undo<2>(filter, row, above, size);
  case 3:
    return undo<3>(filter, row, above, size);
  case 4:
    return undo<4>(filter, row, above, size);
  case 6:
    return undo<6>(filter, row, above, size);
  default:
    return undo<8>(filter, row, above, size);
  }
}

} // namespace parity::base
