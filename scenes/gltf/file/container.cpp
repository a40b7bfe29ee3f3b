// The binary container of glTF 2.0 (.glb).
#include "scenes/gltf/file/container.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::scenes {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kChunkJson = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kChunkBin = 0x004E4942;  // "BIN\0"

std::uint32_t readU32(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<std::uint32_t>(bytes[offset + i]);
  return value;
}

} // namespace

bool isGlb(std::span<const std::byte> bytes) {
  // A prefix of the magic is a truncated container, not JSON: no JSON text starts with 'g'.
  constexpr char kStart[] = {'g', 'l', 'T', 'F'};
  return !bytes.empty() && std::memcmp(bytes.data(), kStart, std::min<std::size_t>(bytes.size(), 4)) == 0;
}

GlbChunks splitGlb(std::span<const std::byte> bytes, const std::string& label) {
  const auto fail = [&](std::size_t offset, const std::string& reason) {
    return base::fileError(label, fmt::format("byte {}", offset), reason);
  };
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (bytes.size() < kHeader) throw fail(bytes.size(), fmt::format("is truncated: a glb header has {} bytes", kHeader));
  if (readU32(bytes, 0) != kMagic) throw fail(0, "is not a glb: the magic 'glTF' is missing");
  if (const std::uint32_t version = readU32(bytes, 4); version != 2)
    throw fail(4, fmt::format("glb version {} is not 2", version));
  const std::size_t length = readU32(bytes, 8);
  if (length > bytes.size()) throw fail(bytes.size(), fmt::format("is truncated: the header says {} bytes", length));
  if (length < kHeader + kChunkHeader) throw fail(8, fmt::format("a length of {} has no room for a chunk", length));

  GlbChunks chunks;
  std::size_t offset = kHeader;
  for (int number = 0; offset < length; ++number) {
    if (length - offset < kChunkHeader) throw fail(offset, "a chunk header is truncated");
    const std::size_t size = readU32(bytes, offset);
    const std::uint32_t type = readU32(bytes, offset + 4);
    const std::size_t begin = offset + kChunkHeader;
    if (size > length - begin)
      throw fail(offset, fmt::format("chunk {} of {} bytes ends outside the file", number, size));
    if (number == 0) {
      if (type != kChunkJson) throw fail(offset + 4, "the first chunk is not JSON");
      chunks.json = {reinterpret_cast<const char*>(bytes.data()) + begin, size};
    } else if (number == 1 && type == kChunkBin) {
      chunks.binary = bytes.subspan(begin, size);
      chunks.hasBinary = true;
    } // chunks of other types are to be ignored
    // Chunks are padded to 4 bytes; a file that forgot to pad its last one is still whole.
    offset = begin + std::min((size + 3) / 4 * 4, length - begin);
  }
  return chunks;
}

} // namespace parity::scenes
