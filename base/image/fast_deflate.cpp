// DEFLATE (RFC 1951) with codes for each block, and runs of zeros as the only repetitions.
#include "base/image/fast_deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <libdeflate.h>

#include "base/image/huffman_code.h"

namespace parity::base {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16; // pictures change: of twice as many 1 % more bytes
constexpr std::size_t kLiterals = 256, kEnd = 256, kFirstLength = 257, kSymbols = 286;
constexpr std::size_t kShortestRun = 8, kLongestMatch = 258;
constexpr int kMaxCodeBits = 12; // four codes fit beside what is left of a byte

// RFC 1951, 3.2.5: the least length of each symbol, and the bits behind it.
constexpr std::array<std::uint16_t, 29> kLengths{3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                                 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr int extraBits(std::size_t symbol) {
  return symbol < 8 || symbol == 28 ? 0 : static_cast<int>(symbol - 4) / 4;
}

constexpr std::array<std::uint8_t, kLongestMatch + 1> makeLengthSymbols() {
  std::array<std::uint8_t, kLongestMatch + 1> symbols{};
  for (std::size_t s = 0; s < kLengths.size(); ++s)
    for (std::size_t length = kLengths[s]; length < symbols.size(); ++length)
      symbols[length] = static_cast<std::uint8_t>(s);
  return symbols;
}
constexpr auto kLengthSymbols = makeLengthSymbols();

// The lowest bit first. Writes up to 8 bytes past what it has; the caller has left room for them.
class BitWriter {
public:
  explicit BitWriter(std::byte* to) : m_to(to) {}

  // At most 56 bits between two calls of flush().
  void add(std::uint64_t bits, int count) {
    m_bits |= bits << m_count;
    m_count += count;
  }
  void flush() {
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(m_to, &m_bits, sizeof(m_bits));
    m_to += m_count >> 3;
    m_bits >>= m_count & ~7;
    m_count &= 7;
  }
  // Zeros up to a whole byte.
  void finish() {
    m_count += 7;
    flush();
    m_count = 0, m_bits = 0;
  }
  std::byte* position() const { return m_to; }
  void moveTo(std::byte* to) { m_to = to; } // the bits of a byte that is not whole come along

private:
  std::byte* m_to;
  std::uint64_t m_bits = 0;
  int m_count = 0;
};

std::size_t zerosAt(const std::uint8_t* at, const std::uint8_t* end) {
  const std::uint8_t* const begin = at;
  for (std::uint64_t eight = 0; end - at >= 8; at += 8) {
    std::memcpy(&eight, at, 8);
    if (eight != 0) break;
  }
  while (at < end && *at == 0) ++at;
  return static_cast<std::size_t>(at - begin);
}

// The tokens of a block: eight(pointer) for so many literals, one(value) for a literal, and match(length) for a match
// with the zero before it.
template <typename Eight, typename One, typename Match>
void scan(std::span<const std::uint8_t> block, const Eight& eight, const One& one, const Match& match) {
  const std::uint8_t *at = block.data(), *const end = at + block.size();
  while (end - at >= 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, at, 8);
    if (bytes != 0) {
      eight(at);
      at += 8;
      continue;
    }
    std::size_t run = zerosAt(at, end);
    at += run;
    one(std::uint8_t{0});
    for (--run; run >= kLengths[0]; run -= std::min(run, kLongestMatch)) match(std::min(run, kLongestMatch));
    for (; run > 0; --run) one(std::uint8_t{0});
  }
  for (; at < end; ++at) one(*at);
}

using Counts = std::array<std::uint32_t, kSymbols>;
using Codes = std::array<HuffmanCode, kSymbols>;

Counts countSymbols(std::span<const std::uint8_t> block) {
  std::array<std::array<std::uint32_t, kLiterals>, 4> literals{}; // one after another a counter would wait for itself
  Counts counts{};
  scan(
      block,
      [&](const std::uint8_t* at) {
        ++literals[0][at[0]], ++literals[1][at[1]], ++literals[2][at[2]], ++literals[3][at[3]];
        ++literals[0][at[4]], ++literals[1][at[5]], ++literals[2][at[6]], ++literals[3][at[7]];
      },
      [&](std::uint8_t value) { ++literals[0][value]; },
      [&](std::size_t length) { ++counts[kFirstLength + kLengthSymbols[length]]; });
  for (std::size_t i = 0; i < kLiterals; ++i)
    counts[i] = literals[0][i] + literals[1][i] + literals[2][i] + literals[3][i];
  counts[kEnd] = 1;
  return counts;
}

// The lengths of the codes, as RFC 1951, 3.2.7, packs them: 16 repeats the last one, 17 and 18 are zeros.
struct LengthToken {
  std::uint8_t symbol, extra, extraBits;
};

std::vector<LengthToken> packLengths(std::span<const std::uint8_t> lengths) {
  std::vector<LengthToken> tokens;
  for (std::size_t at = 0; at < lengths.size();) {
    std::size_t run = 1;
    while (at + run < lengths.size() && lengths[at + run] == lengths[at]) ++run;
    const std::uint8_t length = lengths[at];
    at += run;
    if (length != 0) {
      tokens.push_back({length, 0, 0});
      --run;
    }
    const auto take = [&](std::size_t least, std::size_t most, std::uint8_t symbol, std::uint8_t bits) {
      for (; run >= least; run -= std::min(run, most))
        tokens.push_back({symbol, static_cast<std::uint8_t>(std::min(run, most) - least), bits});
    };
    if (length == 0) take(11, 138, 18, 7);
    if (length == 0) take(3, 10, 17, 3);
    if (length != 0) take(3, 6, 16, 2);
    for (; run > 0; --run) tokens.push_back({length, 0, 0});
  }
  return tokens;
}

void writeCodes(BitWriter& writer, const Codes& codes) {
  constexpr std::array<std::uint8_t, 19> kOrder{16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint8_t, kSymbols + 1> lengths{};
  for (std::size_t i = 0; i < kSymbols; ++i) lengths[i] = codes[i].length;
  lengths[kSymbols] = 1; // the one distance
  const std::vector<LengthToken> tokens = packLengths(lengths);
  std::array<std::uint32_t, 19> counts{};
  for (const LengthToken& token : tokens) ++counts[token.symbol];
  const auto lengthCodes = makeHuffmanCodes(counts, 7);
  std::size_t written = kOrder.size();
  while (written > 4 && lengthCodes[kOrder[written - 1]].length == 0) --written;
  writer.add(kSymbols - 257, 5);
  writer.add(0, 5); // one code of a distance
  writer.add(written - 4, 4);
  for (std::size_t i = 0; i < written; ++i) {
    writer.flush();
    writer.add(lengthCodes[kOrder[i]].length, 3);
  }
  for (const LengthToken& token : tokens) {
    writer.flush();
    writer.add(lengthCodes[token.symbol].bits, lengthCodes[token.symbol].length);
    writer.add(token.extra, token.extraBits);
  }
  writer.flush();
}

void writeTokens(BitWriter& writer, const Codes& codes, std::span<const std::uint8_t> block) {
  const auto put = [&](std::size_t symbol) { writer.add(codes[symbol].bits, codes[symbol].length); };
  scan(
      block,
      [&](const std::uint8_t* at) {
        for (int half = 0; half < 2; ++half, at += 4) {
          put(at[0]), put(at[1]), put(at[2]), put(at[3]);
          writer.flush();
        }
      },
      [&](std::uint8_t value) {
        put(value);
        writer.flush();
      },
      [&](std::size_t length) {
        const std::size_t symbol = kLengthSymbols[length];
        put(kFirstLength + symbol);
        writer.add(length - kLengths[symbol], extraBits(symbol));
        writer.add(0, 1); // the distance 1
        writer.flush();
      });
  put(kEnd);
  writer.flush();
}

// A block of codes takes at most this: 12 bits a byte, and the codes.
constexpr std::size_t kMaxBlockBytes = kBlockBytes * kMaxCodeBits / 8 + 1024;

} // namespace

void appendFastZlib(std::vector<std::byte>& out, std::span<const std::uint8_t> bytes) {
  out.push_back(std::byte{0x78}); // a window of 32 KiB
  out.push_back(std::byte{0x01}); // the fastest algorithm
  // All blocks go through one buffer, from which as much is taken as each has; bits cross its border.
  std::vector<std::byte> buffer(kMaxBlockBytes);
  BitWriter writer(buffer.data());
  for (std::size_t at = 0;; at += kBlockBytes) {
    const auto block = bytes.subspan(at, std::min(kBlockBytes, bytes.size() - at));
    const bool isLast = at + block.size() == bytes.size();
    const Codes codes = makeHuffmanCodes(countSymbols(block), kMaxCodeBits);
    writer.add(isLast ? 1 : 0, 1);
    writer.add(2, 2); // codes of its own
    writeCodes(writer, codes);
    writeTokens(writer, codes, block);
    if (isLast) writer.finish();
    out.insert(out.end(), buffer.data(), writer.position());
    writer.moveTo(buffer.data());
    if (isLast) break;
  }
  const std::uint32_t checksum = libdeflate_adler32(1, bytes.data(), bytes.size());
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(checksum >> shift));
}

} // namespace parity::base
