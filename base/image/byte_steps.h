// A transfer function to bytes, as a table of the values at which the byte steps up.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace parity::base {

// Bytes of a function of one value, exactly as the function gives them.
class ByteSteps {
public:
  // encode: bytes of as many values in [0, 1]; is called some 30 times, with 255 values each. It must never fall, and
  // give 0 at 0 and 255 at 1.
  explicit ByteSteps(const std::function<void(std::span<const float>, std::span<std::uint8_t>)>& encode);

  // At and below 0, and for NaN, the byte is 0; from 1 on it is 255.
  std::uint8_t operator()(float value) const {
    if (!(value >= m_least[1])) return 0;
    if (value >= m_least[kSteps]) return kSteps;
    std::uint8_t byte = m_begin[(bitsOf(value) - bitsOf(m_least[1])) >> kShift];
    while (value >= m_least[byte + 1u]) ++byte; // once at the most for a curve such as sRGB's
    return byte;
  }

private:
  static constexpr std::uint8_t kSteps = 255;
  static constexpr int kShift = 15; // 256 entries of m_begin for a factor of two
  static std::uint32_t bitsOf(float value) { return std::bit_cast<std::uint32_t>(value); }

  std::array<float, kSteps + 1u> m_least{}; // the least value that is shown as this byte or a greater one
  std::vector<std::uint8_t> m_begin;        // of intervals of values from m_least[1] on: the byte where one begins
};

} // namespace parity::base
