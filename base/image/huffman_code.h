// Huffman codes of limited length, in the order that DEFLATE has (RFC 1951, 3.2.2).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace parity::base {

struct HuffmanCode {
  std::uint16_t bits = 0; // the first bit is the lowest
  std::uint8_t length = 0;
};

// The best codes for these counts, or nearly where the limit cuts them: a symbol that does not occur has none. Where
// only one occurs, it has one bit.
template <std::size_t N>
std::array<HuffmanCode, N> makeHuffmanCodes(const std::array<std::uint32_t, N>& counts, int maxLength) {
  // Leaves by their count; equal ones by their number, so that the result is one.
  std::array<std::uint64_t, N> leaves;
  std::size_t used = 0;
  for (std::size_t i = 0; i < N; ++i)
    if (counts[i] > 0) leaves[used++] = std::uint64_t{counts[i]} << 16 | i;
  std::array<HuffmanCode, N> codes{};
  if (used == 0) return codes;
  std::sort(leaves.begin(), leaves.begin() + used);

  // Two queues (van Leeuwen, 1976): leaves and inner nodes, each in order of weight.
  std::array<std::uint64_t, N> weights{};
  std::array<std::uint16_t, 2 * N> parents{}; // leaves, then inner nodes
  std::size_t leaf = 0, inner = 0;
  for (std::size_t made = 0; made + 1 < used; ++made)
    for (int side = 0; side < 2; ++side) {
      const bool takesLeaf = leaf < used && (inner >= made || leaves[leaf] >> 16 <= weights[inner]);
      weights[made] += takesLeaf ? leaves[leaf] >> 16 : weights[inner];
      parents[takesLeaf ? leaf++ : N + inner++] = static_cast<std::uint16_t>(N + made);
    }

  // How many codes there are of each length. What is too long is cut, and others become longer for it.
  constexpr std::size_t kLongest = 32;
  std::array<std::uint32_t, kLongest> lengths{};
  std::array<std::uint8_t, N> depths{};
  const std::size_t limit = static_cast<std::size_t>(maxLength);
  for (std::size_t node = used - 1; node-- > 0;)
    depths[node] = node + 2 == used
                       ? 0
                       : static_cast<std::uint8_t>(std::min<std::size_t>(depths[parents[N + node] - N] + 1u, kLongest));
  for (std::size_t i = 0; i < used; ++i)
    ++lengths[used == 1 ? 1 : std::min<std::size_t>(depths[parents[i] - N] + 1u, limit)];
  std::uint32_t total = 0;
  for (std::size_t length = 1; length <= limit; ++length) total += lengths[length] << (limit - length);
  for (; total > 1u << limit; --total) {
    std::size_t shorter = limit - 1;
    while (lengths[shorter] == 0) --shorter;
    --lengths[limit], --lengths[shorter], lengths[shorter + 1] += 2;
  }

  // The rarest have the longest codes; codes of one length are in order of the symbols.
  std::size_t next = 0;
  for (std::size_t length = limit; length > 0; --length)
    for (std::uint32_t n = 0; n < lengths[length]; ++n)
      codes[leaves[next++] & 0xffff].length = static_cast<std::uint8_t>(length);
  std::array<std::uint32_t, kLongest> first{};
  for (std::size_t length = 1; length < limit; ++length) first[length + 1] = (first[length] + lengths[length]) << 1;
  for (HuffmanCode& code : codes) {
    std::uint32_t value = code.length ? first[code.length]++ : 0;
    for (int i = 0; i < code.length; ++i, value >>= 1)
      code.bits = static_cast<std::uint16_t>(code.bits << 1 | (value & 1));
  }
  return codes;
}

} // namespace parity::base
