#include "base/image/byte_steps.h"

namespace parity::base {

ByteSteps::ByteSteps(const std::function<void(std::span<const float>, std::span<std::uint8_t>)>& encode) {
  // Bits of positive floats are in the order of the floats.
  std::array<std::uint32_t, kSteps> below{}, above{};
  above.fill(bitsOf(1.f));
  std::array<float, kSteps> asked{};
  std::array<std::uint8_t, kSteps> bytes{};
  // Each round halves what is between, until that is one float.
  for (std::uint32_t between = above.front(); between > 1; between -= between / 2) {
    for (std::size_t k = 0; k < kSteps; ++k) asked[k] = std::bit_cast<float>(below[k] + (above[k] - below[k]) / 2);
    encode(asked, bytes);
    for (std::size_t k = 0; k < kSteps; ++k) (bytes[k] > k ? above : below)[k] = bitsOf(asked[k]);
  }
  for (std::size_t k = 0; k < kSteps; ++k) m_least[k + 1] = std::bit_cast<float>(above[k]);
  std::uint8_t byte = 1;
  for (std::uint32_t bits = above.front(); bits <= above.back(); bits += 1u << kShift) {
    while (byte < kSteps && std::bit_cast<float>(bits) >= m_least[byte + 1u]) ++byte;
    m_begin.push_back(byte);
  }
}

} // namespace parity::base
