// IEEE binary16 numbers whose every operation rounds to nearest even, as a device without fused half arithmetic does.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <limits>

namespace parity::shading {

// A half, stored as its 16 bits. Denormals are kept. Each operation is done in float and rounded once: for + - * / and
// sqrt that equals rounding the exact result (24 >= 2*11 + 2; Figueroa 1995). The compiler's own _Float16 is not used:
// its expressions may keep excess precision, and not every compiler in use has it. Narrowing is explicit; widening to
// float is implicit, as in GLSL.
class Half {
public:
  constexpr Half() = default;
  constexpr explicit Half(double value) : m_bits(roundToBits(value)) {} // once, not through float
  constexpr explicit Half(float value) : m_bits(roundToBits(value)) {}
  constexpr explicit Half(int value) : m_bits(roundToBits(value)) {}

  constexpr operator float() const {
    const std::uint32_t sign = static_cast<std::uint32_t>(m_bits & 0x8000u) << 16;
    const std::uint32_t magnitude = m_bits & 0x7fffu;
    if (magnitude >= 0x7c00u) return std::bit_cast<float>(sign | 0x7f800000u | (magnitude & 0x3ffu) << 13);
    if (magnitude < 0x400u) { // denormal or zero: a multiple of 2^-24
      const float value = static_cast<float>(magnitude) * 0x1p-24f;
      return sign != 0 ? -value : value;
    }
    return std::bit_cast<float>(sign | ((magnitude << 13) + ((127u - 15u) << 23)));
  }

  friend constexpr Half operator+(Half a, Half b) { return Half(float(a) + float(b)); }
  friend constexpr Half operator-(Half a, Half b) { return Half(float(a) - float(b)); }
  friend constexpr Half operator*(Half a, Half b) { return Half(float(a) * float(b)); }
  friend constexpr Half operator/(Half a, Half b) { return Half(float(a) / float(b)); }
  friend constexpr Half operator-(Half a) { return fromBits(static_cast<std::uint16_t>(a.m_bits ^ 0x8000u)); }
  friend constexpr bool operator==(Half a, Half b) { return float(a) == float(b); }
  friend constexpr std::partial_ordering operator<=>(Half a, Half b) { return float(a) <=> float(b); }

  // The 16 bits as stored, and back.
  constexpr std::uint16_t bits() const { return m_bits; }
  static constexpr Half fromBits(std::uint16_t bits) {
    Half h;
    h.m_bits = bits;
    return h;
  }

private:
  static constexpr std::uint16_t roundToBits(double value) {
    const std::uint64_t all = std::bit_cast<std::uint64_t>(value);
    const std::uint16_t sign = static_cast<std::uint16_t>(all >> 48 & 0x8000u);
    const double a = std::bit_cast<double>(all & ~(std::uint64_t{1} << 63));
    if (a != a) return static_cast<std::uint16_t>(sign | 0x7e00u);
    if (a >= 65520.0) return static_cast<std::uint16_t>(sign | 0x7c00u); // from here the nearest is 65536, which is inf
    if (a < 0x1p-14) { // adding 2^52 rounds to a whole number of 2^-24, ties to even
      const double units = (a * 0x1p24 + 0x1p52) - 0x1p52;
      return static_cast<std::uint16_t>(sign | static_cast<std::uint16_t>(units));
    }
    std::uint64_t bits = std::bit_cast<std::uint64_t>(a);
    bits += ((std::uint64_t{1} << 41) - 1) + (bits >> 42 & 1u); // to nearest, ties to even, at bit 42
    return static_cast<std::uint16_t>(sign | ((bits >> 42) - (std::uint64_t{1023 - 15} << 10)));
  }

  std::uint16_t m_bits = 0;
};

// The smallest normal and the largest finite number of each precision.
template <typename T> inline constexpr T kSmallestNormal = std::numeric_limits<T>::min();
template <> inline constexpr Half kSmallestNormal<Half> = Half(0x1p-14);
template <typename T> inline constexpr T kLargestFinite = std::numeric_limits<T>::max();
template <> inline constexpr Half kLargestFinite<Half> = Half(65504.0);

} // namespace parity::shading
