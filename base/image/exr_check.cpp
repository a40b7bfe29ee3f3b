// What an OpenEXR header asks for ("OpenEXR File Layout", Academy Software Foundation), before memory is taken.
#include "base/image/exr_check.h"

#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image.h"

namespace parity::base {

namespace {

constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";
constexpr std::uint32_t kDeepFlag = 0x800, kMultiPartFlag = 0x1000;
constexpr std::size_t kOffsetBytes = 8; // of a chunk, in the table behind the headers
constexpr std::int64_t kMaxChunkBytes = std::int64_t{1} << 28;
// By the number of the compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::int64_t kLinesAChunk[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

// What the values of a type take (OpenEXR, "Predefined Attribute Types"): the library reads so many, whatever the
// header says that there are.
struct TypeSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr TypeSize kTypeSizes[] = {{"box2i", 16},
                                   {"box2f", 16},
                                   {"chromaticities", 32},
                                   {"compression", 1},
                                   {"deepImageState", 1},
                                   {"double", 8},
                                   {"envmap", 1},
                                   {"float", 4},
                                   {"int", 4},
                                   {"keycode", 28},
                                   {"lineOrder", 1},
                                   {"m33f", 36},
                                   {"m33d", 72},
                                   {"m44f", 64},
                                   {"m44d", 128},
                                   {"rational", 8},
                                   {"tiledesc", 9},
                                   {"timecode", 8},
                                   {"v2i", 8},
                                   {"v2f", 8},
                                   {"v2d", 16},
                                   {"v3i", 12},
                                   {"v3f", 12},
                                   {"v3d", 24}};

std::int64_t readInt(std::string_view bytes) {
  std::int32_t value = 0;
  std::memcpy(&value, bytes.data(), sizeof(value)); // little-endian, as the format is
  return value;
}

class Walk {
public:
  Walk(std::string_view head, std::size_t fileBytes, const std::string& name)
      : m_rest(head), m_headBytes(head.size()), m_fileBytes(fileBytes), m_name(name) {}

  void run() {
    if (!m_rest.starts_with(kExrMagic) || m_rest.size() < 8) return;
    const auto version = static_cast<std::uint32_t>(readInt(m_rest.substr(4)));
    if (version & kDeepFlag) fail("is a deep image; give a flat image");
    m_rest.remove_prefix(8);
    if (!walkHeader()) return;
    while (version & kMultiPartFlag && !m_rest.empty() && m_rest[0] != '\0')
      if (!walkHeader()) return;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw fileError(m_name, "header", reason); }

  // Up to the next zero; nothing where the bytes end before.
  std::optional<std::string_view> takeText() {
    const std::size_t end = m_rest.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = m_rest.substr(0, end);
    m_rest.remove_prefix(end + 1);
    return text;
  }

  // False where the bytes end within the header: the library says so of a file, and of a head there is no more to see.
  bool walkHeader() {
    std::int64_t width = 0, height = 0, tileWidth = 0, tileHeight = 0, channels = 0, lines = 1;
    for (;;) {
      const auto attribute = takeText();
      if (!attribute) return false;
      if (attribute->empty()) break;
      const auto type = takeText();
      if (!type || m_rest.size() < 4) return false;
      const std::int64_t size = readInt(m_rest);
      m_rest.remove_prefix(4);
      const std::size_t left = m_fileBytes - (m_headBytes - m_rest.size());
      if (size < 0 || static_cast<std::size_t>(size) > left)
        fail(fmt::format("an attribute has {} bytes, expected at most {}, the rest of the file", size, left));
      for (const TypeSize& each : kTypeSizes)
        if (*type == each.type && static_cast<std::size_t>(size) != each.bytes)
          fail(fmt::format("an attribute of type {} has {} bytes, expected {}", each.type, size, each.bytes));
      if (static_cast<std::size_t>(size) > m_rest.size()) return false;
      const std::string_view value = m_rest.substr(0, static_cast<std::size_t>(size));
      m_rest.remove_prefix(value.size());
      checkLength(*type, value);
      if (*attribute == "dataWindow" && value.size() == 16) {
        width = readInt(value.substr(8)) - readInt(value) + 1;
        height = readInt(value.substr(12)) - readInt(value.substr(4)) + 1;
        checkImageSize(m_name, width, height, 1);
      } else if (*attribute == "tiles" && value.size() == 9) {
        tileWidth = readInt(value), tileHeight = readInt(value.substr(4));
        if (tileWidth < 1 || tileHeight < 1 || tileWidth > kMaxImageSide || tileHeight > kMaxImageSide)
          fail(fmt::format("tiles of {} x {} pixels", tileWidth, tileHeight));
      } else if (*attribute == "channels" && *type == "chlist") {
        channels = countChannels(value);
      } else if (*attribute == "compression" && value.size() == 1) {
        if (const auto number = static_cast<unsigned char>(value[0]); number < std::size(kLinesAChunk))
          lines = kLinesAChunk[number];
      } else if (*attribute == "chunkCount" && value.size() == 4) {
        checkChunks(readInt(value));
      } else if (*attribute == "type" && value.starts_with("deep")) {
        fail("is a deep image; give a flat image");
      }
    }
    if (tileWidth > 0) checkChunks((width + tileWidth - 1) / tileWidth * ((height + tileHeight - 1) / tileHeight));
    // The library takes the memory of some chunks when it opens the file.
    const std::int64_t texels = tileWidth > 0 ? tileWidth * tileHeight : width * lines;
    if (texels > 0 && channels > kMaxChunkBytes / 4 / texels)
      fail(fmt::format("{} channels of {} texels form one block of more than {} MiB", channels, texels,
                       kMaxChunkBytes >> 20));
    return true;
  }

  // Types that say themselves how long they are must end where the attribute does: the library believes them.
  void checkLength(std::string_view type, std::string_view value) const {
    bool fits = true;
    if (type == "chlist") {
      fits = countChannels(value) >= 0;
    } else if (type == "preview") {
      const bool hasSize = value.size() >= 8;
      const std::int64_t width = hasSize ? readInt(value) : -1, height = hasSize ? readInt(value.substr(4)) : -1;
      const std::int64_t bytes = static_cast<std::int64_t>(value.size()) - 8;
      // The product of two sides of 2^31 and 4 would overflow.
      fits = width >= 0 && height >= 0 && (height == 0 || width <= bytes / 4 / height) && bytes == 4 * width * height;
    } else if (type == "stringvector") {
      while (fits && !value.empty()) {
        const std::int64_t length = value.size() >= 4 ? readInt(value) : -1;
        fits = length >= 0 && static_cast<std::size_t>(length) <= value.size() - 4;
        if (fits) value.remove_prefix(4 + static_cast<std::size_t>(length));
      }
    }
    if (!fits) fail(fmt::format("the length of an attribute of type {} does not match its content", type));
  }

  // A name, a zero and 16 bytes each; a zero ends them. -1 where they do not end with the bytes.
  static std::int64_t countChannels(std::string_view list) {
    constexpr std::size_t kChannelBytes = 16;
    std::int64_t count = 0;
    for (; !list.empty() && list[0] != '\0'; ++count) {
      const std::size_t end = list.find('\0');
      if (end == std::string_view::npos || list.size() - end - 1 < kChannelBytes) return -1;
      list.remove_prefix(end + 1 + kChannelBytes);
    }
    return list.size() == 1 ? count : -1;
  }

  void checkChunks(std::int64_t count) const {
    if (count < 0 || static_cast<std::size_t>(count) > m_fileBytes / kOffsetBytes)
      fail(fmt::format("the image has {} parts, too many for a file of {} bytes", count, m_fileBytes));
  }

  std::string_view m_rest;
  std::size_t m_headBytes, m_fileBytes;
  const std::string& m_name;
};

} // namespace

void checkExr(std::span<const std::byte> head, std::size_t fileBytes, const std::string& name) {
  Walk({reinterpret_cast<const char*>(head.data()), head.size()}, fileBytes, name).run();
}

} // namespace parity::base
