#include "base/image/ktx2.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/basis/basis_module.h"
#include "base/module_file.h"

namespace parity::base {

namespace {

constexpr std::size_t kHeaderBytes = 80, kLevelBytes = 24;
constexpr int kEtc1s = 163, kUastc = 166;                  // colour models of the Khronos Data Format, 1.3, table 5.6
enum Scheme : std::uint32_t { plain, basisLz, zstandard }; // of supercompression

class File {
public:
  File(std::span<const std::byte> bytes, const std::string& name) : m_bytes(bytes), m_name(name) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    throw fileError(m_name, "", "the KTX 2 image " + reason);
  }

  std::uint64_t read(std::size_t at, std::size_t count) const {
    if (at > m_bytes.size() || count > m_bytes.size() - at) refuse("is truncated");
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<std::uint64_t>(m_bytes[at + i]);
    return value;
  }
  std::uint32_t word(std::size_t at) const { return static_cast<std::uint32_t>(read(at, 4)); }

  void requireWithin(std::uint64_t offset, std::uint64_t length, const char* part) const {
    if (offset > m_bytes.size() || length > m_bytes.size() - offset)
      refuse(fmt::format("is truncated: its {} ends beyond the file", part));
  }

private:
  std::span<const std::byte> m_bytes;
  const std::string& m_name;
};

DecodeBasis loadTranscoder() {
  return reinterpret_cast<DecodeBasis>(
      moduleFunction("parity_basis.so", kDecodeBasis,
                     "it is built where npm and wabt are installed: run scripts/install-deps and build again",
                     "KTX 2 textures cannot be read"));
}

} // namespace

Ktx2Header readKtx2Header(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  const File file(bytes, name);
  file.requireWithin(0, kHeaderBytes, "header");
  const std::uint32_t format = file.word(12), width = file.word(20), height = file.word(24), depth = file.word(28),
                      layers = file.word(32), faces = file.word(36), levels = std::max(file.word(40), 1u),
                      scheme = file.word(44), descriptor = file.word(48);
  if (depth != 0 || layers > 1 || faces != 1) file.refuse("is not one two-dimensional picture");
  if (width == 0 || height == 0) file.refuse("has a width or height of 0");
  checkImageSize(name, width, height, 4, limits);
  file.requireWithin(descriptor, file.word(52), "descriptor");
  const auto model = static_cast<int>(file.read(std::size_t{descriptor} + 12, 1));
  const bool isEtc1s = model == kEtc1s, isUastc = model == kUastc;
  if (format != 0 || (!isEtc1s && !isUastc))
    file.refuse("is not Basis Universal (ETC1S or UASTC), which KHR_texture_basisu asks for");
  if (isEtc1s ? scheme != basisLz : scheme != plain && scheme != zstandard)
    file.refuse(
        fmt::format("has the supercompression {}, which does not go with {}", scheme, isEtc1s ? "ETC1S" : "UASTC"));
  constexpr std::uint32_t kMostLevels = 32;
  if (levels > kMostLevels) file.refuse(fmt::format("has {} levels", levels));
  for (std::uint32_t level = 0; level < levels; ++level) {
    const std::size_t at = kHeaderBytes + kLevelBytes * level;
    file.requireWithin(file.read(at, 8), file.read(at + 8, 8), "level");
  }
  file.requireWithin(file.read(64, 8), file.read(72, 8), "table");
  const std::uint64_t blocks = (std::uint64_t{width} + 3) / 4 * ((std::uint64_t{height} + 3) / 4);
  constexpr std::uint64_t kBlockBytes = 16;
  if (isUastc && file.read(kHeaderBytes + 16, 8) != blocks * kBlockBytes)
    file.refuse("has a first level of another size than its width and height");
  // Code, stack and tables of the transcoder; the file, copied twice; the blocks, and their texels twice.
  constexpr std::size_t kOwnBytes = std::size_t{32} << 20, kTexelsOfBlock = 16;
  return {static_cast<int>(width), static_cast<int>(height),
          kOwnBytes + 2 * bytes.size() + blocks * (kBlockBytes + 2 * 4 * kTexelsOfBlock)};
}

Image8 decodeKtx2(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  const Ktx2Header header = readKtx2Header(bytes, name, limits);
  Image8 image(header.width, header.height, 4);
  checkImageBytes(name, fmt::format("a KTX 2 image of {} x {} pixels", header.width, header.height),
                  header.transcoderBytes + image.pixels.size(), limits.maxBytes);
  static const DecodeBasis decode = loadTranscoder(); // tried again after a failure
  std::string damage;
  decode(bytes, header.transcoderBytes, image.pixels, damage);
  if (!damage.empty()) throw fileError(name, "cannot be decoded", "the KTX 2 image: " + damage);
  return image;
}

} // namespace parity::base
