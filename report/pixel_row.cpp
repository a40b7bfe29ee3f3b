#include "report/pixel_row.h"

#include <bit>
#include <cassert>
#include <cstddef>

// The loops are plain: the compiler makes vectors of them for each instruction set that Highway names.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "report/pixel_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::report::HWY_NAMESPACE {

// The nearest half, ties to even, without branches (F. Giesen, "float->half variants", float_to_half_fast3_rtne, 2012).
// Below 2^-14 the float adder rounds: at 0.5 its last bit is worth 2^-24.
HWY_INLINE std::uint16_t toHalf(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  const float size = std::bit_cast<float>(magnitude), limited = size < 65504.f ? size : 65504.f;
  const auto limitedBits = std::bit_cast<std::uint32_t>(limited);
  const std::uint32_t normal = (limitedBits + 0xfffu + (limitedBits >> 13 & 1u) - (112u << 23)) >> 13;
  const std::uint32_t denormal = std::bit_cast<std::uint32_t>(limited + 0.5f) - std::bit_cast<std::uint32_t>(0.5f);
  std::uint32_t half = limitedBits < (113u << 23) ? denormal : normal;
  half = (magnitude == 0x7f800000u ? 0x7c00u : half) | sign;
  return static_cast<std::uint16_t>(magnitude > 0x7f800000u ? 0x7e00u : half); // a NaN, whatever its sign and payload
}

HWY_INLINE std::uint16_t toWhole(float value) { // rounds; a NaN is the largest
  const float above = value > 0.f ? value : 0.f;
  return value < 65535.f ? static_cast<std::uint16_t>(static_cast<std::int32_t>(above + 0.5f)) : std::uint16_t{65535};
}

void PackRow(const float* __restrict values, std::size_t count, PlaneKind kind, std::uint16_t* __restrict packed) {
  if (kind == PlaneKind::rgb16f)
    for (std::size_t i = 0; i < count; ++i) packed[i] = toHalf(values[i]);
  else if (kind == PlaneKind::unorm16)
    for (std::size_t i = 0; i < count; ++i) packed[i] = toWhole(values[i] * 65535.f);
  else
    for (std::size_t i = 0; i < count; ++i) packed[i] = toWhole(values[i]);
}

} // namespace parity::report::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::report {
namespace {

HWY_EXPORT(PackRow);

} // namespace

void packRow(std::span<const float> values, PlaneKind kind, std::span<std::uint16_t> packed) {
  assert(values.size() == packed.size());
  HWY_DYNAMIC_DISPATCH(PackRow)(values.data(), values.size(), kind, packed.data());
}

} // namespace parity::report
#endif
