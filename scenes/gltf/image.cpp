// Images of a glTF file: read, checked against the limits by their headers, decoded in parallel.
#include "scenes/gltf/image.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>
#include <optional>
#include <semaphore>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "base/image/jpeg_check.h"
#include "base/image/ktx2.h"
#include "base/parallel.h"
#include "scenes/gltf/file/image_header.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxImageBytes = std::size_t{512} << 20; // of a file

// One image on its way: its bytes until it is decoded.
struct Encoded {
  std::string place;
  std::vector<std::byte> file;
  std::span<const std::byte> bytes;
  SourceFile source;
  bool isUsable = false, isJpeg = false, isKtx2 = false;
  std::size_t decoderBytes = 0; // that decoding takes beside file and texels
  std::string damage;           // of a JPEG, in libjpeg's words
};

void readEncoded(const GltfDocument& document, const GltfImageSource& source, Encoded& encoded) {
  if (source.bufferView >= 0)
    encoded.bytes = document.bufferView(source.bufferView);
  else if (!source.file.empty()) {
    try {
      const std::size_t bytes = base::regularFileSize(source.file);
      if (bytes > kMaxImageBytes) throw document.error("", fmt::format("is larger than {} MiB", kMaxImageBytes >> 20));
      document.memory.take(bytes, encoded.place);
      encoded.file = base::readFile(source.file, bytes);
    } catch (const base::Error& error) {
      throw document.error(encoded.place, error.reason());
    }
    encoded.bytes = encoded.file;
    encoded.source = sourceFile(source.named, encoded.file);
  } else
    encoded.bytes = source.embedded;
}

// The texels of the image, by its header; sets its kind. Throws Error (exit 4).
std::size_t checkHeader(const GltfDocument& document, Encoded& encoded, std::size_t texelsBefore) {
  const LoadOptions& options = document.options;
  const auto fail = [&](const std::string& reason) { return document.error(encoded.place, reason); };
  if (encoded.bytes.empty()) throw fail("the image is empty");
  ImageHeader header = readImageHeader(encoded.bytes);
  if (header.format == ImageFormat::unknown) throw fail("is not a PNG, JPEG, WebP or KTX 2 image");
  encoded.isKtx2 = header.format == ImageFormat::ktx2;
  if (encoded.isKtx2) {
    try {
      const base::Ktx2Header ktx2 = base::readKtx2Header(encoded.bytes, encoded.place);
      header.width = static_cast<std::size_t>(ktx2.width);
      header.height = static_cast<std::size_t>(ktx2.height);
      encoded.decoderBytes = ktx2.transcoderBytes;
    } catch (const base::Error& error) {
      throw fail(error.reason());
    }
  }
  if (header.width == 0 || header.height == 0) throw fail("has a width or height of 0, or a truncated header");
  if (std::max(header.width, header.height) > options.maxImageSide)
    throw fail(fmt::format("has {}x{} pixels, expected at most {} a side (--max-image)", header.width, header.height,
                           options.maxImageSide));
  const std::size_t texels = header.width * header.height;
  if (texels > options.maxImageTexels || texelsBefore > options.maxImageTexels - texels)
    throw fail(
        fmt::format("the images of the scene have more than {} texels together (--max-image)", options.maxImageTexels));
  if (header.isCutOff) throw fail("is truncated: the end marker is missing");
  document.memory.take(texels * 4, encoded.place);
  encoded.isJpeg = header.format == ImageFormat::jpeg;
  return texels;
}

// However many threads there are, so many KTX 2 images are decoded at a time: what they take together is then the same
// on every machine.
constexpr std::ptrdiff_t kTranscoders = 4;

// One of them, as long as this lives.
class Turn {
public:
  explicit Turn(std::counting_semaphore<>& turns) : m_turns(turns) { m_turns.acquire(); }
  ~Turn() { m_turns.release(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

private:
  std::counting_semaphore<>& m_turns;
};

std::size_t transcoderBytes(const std::vector<Encoded>& all) {
  std::vector<std::size_t> bytes;
  for (const Encoded& each : all) bytes.push_back(each.decoderBytes);
  std::sort(bytes.begin(), bytes.end(), std::greater<>());
  bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(kTranscoders)));
  return std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
}

} // namespace

DecodedImages decodeImages(const GltfDocument& document, const std::vector<int>& used, Problems& problems) {
  std::vector<Encoded> all(used.size());
  std::size_t texels = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const GltfImageSource& source = document.images[static_cast<std::size_t>(used[i])];
    all[i].place = fmt::format("/images/{} '{}'", used[i], source.name);
    all[i].isUsable = problems.attempt([&] {
      readEncoded(document, source, all[i]);
      texels += checkHeader(document, all[i], texels);
    });
  }

  DecodedImages decoded;
  decoded.images.resize(used.size());
  std::vector<std::optional<base::Error>> failed(used.size());
  std::counting_semaphore<> transcoders(kTranscoders);
  std::optional<MemoryCharge> charge;
  problems.attempt([&] { charge.emplace(document.memory, transcoderBytes(all), "/images"); });
  if (!charge) return decoded;
  // In order, whichever thread is free: images that are uploaded, and freed, one after another then lie side by side in
  // memory, where the device's image of the next texture finds room.
  std::atomic<std::size_t> next{0};
  base::parallelFor(used.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t taken = begin; taken < end; ++taken) {
      const std::size_t i = next++;
      decoded.images[i].name = document.images[static_cast<std::size_t>(used[i])].name;
      if (!all[i].isUsable) continue;
      try {
        const std::string& name = decoded.images[i].name;
        const base::ImageLimits limits = {.maxBytes = document.options.maxMemoryBytes};
        if (all[i].isKtx2) {
          const Turn turn(transcoders);
          decoded.images[i].pixels = base::decodeKtx2(all[i].bytes, name, limits);
        } else
          decoded.images[i].pixels = base::decodeImage8(all[i].bytes, name, 4, limits);
        if (all[i].isJpeg) all[i].damage = base::findJpegDamage(all[i].bytes);
      } catch (const base::Error& error) {
        failed[i] = document.error(all[i].place, error.reason());
      }
      document.memory.release(all[i].file.size());
      std::vector<std::byte>().swap(all[i].file);
    }
  });
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (failed[i]) problems.add(*failed[i]);
    if (!all[i].damage.empty())
      decoded.warnings.push_back(
          fmt::format("{}: the JPEG is damaged; the decoder invented a part of it ({})", all[i].place, all[i].damage));
    if (!all[i].source.file.empty()) decoded.sources.push_back(all[i].source);
  }
  return decoded;
}

} // namespace parity::scenes
