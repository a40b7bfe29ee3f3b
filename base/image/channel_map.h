// From a file's channels to as many as are wanted, as 8 bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace parity::base {

inline std::uint8_t to8(std::uint8_t v) { return v; }
inline std::uint8_t to8(std::uint16_t v) { return static_cast<std::uint8_t>((v + 128u) / 257u); } // round(v / 257)

// One of the file's channels may be alpha. Of the wanted ones an even number has alpha as the last.
class ChannelMap {
public:
  // alpha: the file's channel, or -1.
  ChannelMap(int from, int alpha, int to) : m_from(from), m_alpha(alpha), m_to(to) {}

  bool keepsAll() const {
    const bool hasAlpha = m_alpha >= 0;
    return m_from == m_to && (!hasAlpha || m_alpha == m_from - 1) && hasAlpha == (m_to % 2 == 0);
  }

  template <typename T> void convert(const T* in, std::size_t count, std::uint8_t* out) const {
    const int colors = m_from - (m_alpha >= 0 ? 1 : 0);
    const bool wantsAlpha = m_to % 2 == 0;
    const int wantedColors = m_to - (wantsAlpha ? 1 : 0);
    for (std::size_t i = 0; i < count; ++i, in += m_from, out += m_to) {
      for (int c = 0; c < wantedColors; ++c) out[c] = to8(in[colors >= 3 ? c : 0]);
      if (wantsAlpha) out[wantedColors] = m_alpha >= 0 ? to8(in[m_alpha]) : std::uint8_t{255};
    }
  }

private:
  int m_from, m_alpha, m_to;
};

} // namespace parity::base
