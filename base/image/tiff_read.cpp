// The parts of a TIFF file are unpacked by libtiff, on all cores.
#include "base/image/tiff_read.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/image/channel_map.h"
#include "base/image/tiff_file.h"
#include "base/image/tiff_part.h"
#include "base/parallel.h"

namespace parity::base {

namespace {

// As many readers as threads work at the same time.
class TiffPartReaders {
public:
  TiffPartReaders(const std::filesystem::path& file, const TiffLayout& layout, const ImageLimits& limits)
      : m_path(file), m_layout(layout), m_limits(limits) {}

  std::unique_ptr<TiffPartReader> take() {
    {
      const std::lock_guard lock(m_mutex);
      if (!m_free.empty()) {
        std::unique_ptr<TiffPartReader> reader = std::move(m_free.back());
        m_free.pop_back();
        return reader;
      }
    }
    return std::make_unique<TiffPartReader>(m_path, m_layout, m_limits);
  }
  void giveBack(std::unique_ptr<TiffPartReader> reader) {
    const std::lock_guard lock(m_mutex);
    m_free.push_back(std::move(reader));
  }

private:
  const std::filesystem::path& m_path;
  const TiffLayout& m_layout;
  const ImageLimits& m_limits;
  std::mutex m_mutex;
  std::vector<std::unique_ptr<TiffPartReader>> m_free;
};

class TiffReading {
public:
  TiffReading(const std::filesystem::path& file, const TiffLayout& layout, const ImageLimits& limits)
      : m_layout(layout), m_readers(file, layout, limits) {}

  // Nothing where the image library has to read it.
  template <typename T> std::optional<BasicImage<T>> run() {
    BasicImage<T> image;
    image.width = m_layout.width, image.height = m_layout.height, image.channels = m_layout.channels;
    const std::size_t lineValues =
        static_cast<std::size_t>(m_layout.width) * static_cast<std::size_t>(m_layout.channels);
    image.pixels.reserve(lineValues * static_cast<std::size_t>(m_layout.height));
    const int band = std::max(1, kBandLines / m_layout.partHeight); // rows of parts
    for (int row = 0; row < m_layout.down; row += band) {
      const int end = std::min(row + band, m_layout.down);
      if (!isLarge(row, end)) return std::nullopt;
      image.pixels.resize(lineValues * static_cast<std::size_t>(std::min(end * m_layout.partHeight, m_layout.height)));
      if (!readBand(row, end, reinterpret_cast<std::uint8_t*>(image.pixels.data()))) return std::nullopt;
    }
    return image;
  }

private:
  static constexpr int kBandLines = 256; // a file that ends early has memory touched for no more than it holds
  static constexpr int kTaskLines = 64;

  TiffPart partAt(int plane, int row, int column) const {
    TiffPart part;
    part.x = column * m_layout.partWidth, part.y = row * m_layout.partHeight;
    part.width = std::min(m_layout.partWidth, m_layout.width - part.x);
    part.height = std::min(m_layout.partHeight, m_layout.height - part.y);
    part.index = static_cast<std::uint32_t>((plane * m_layout.down + row) * m_layout.across + column);
    return part;
  }

  template <typename Body> bool forParts(int row, int end, const Body& body) const {
    for (int plane = 0; plane < m_layout.planes(); ++plane)
      for (int r = row; r < end; ++r)
        for (int column = 0; column < m_layout.across; ++column)
          if (!body(plane, partAt(plane, r, column))) return false;
    return true;
  }

  bool isLarge(int row, int end) {
    std::unique_ptr<TiffPartReader> reader = m_readers.take();
    const bool isLarge =
        reader->isReady() && forParts(row, end, [&](int, const TiffPart& part) { return reader->isLarge(part); });
    m_readers.giveBack(std::move(reader));
    return isLarge;
  }

  bool readBand(int row, int end, std::uint8_t* pixels) {
    std::atomic<bool> isWhole = true;
    const auto grain = static_cast<std::size_t>(std::max(1, kTaskLines / m_layout.partHeight));
    parallelFor(static_cast<std::size_t>(end - row), grain, [&](std::size_t from, std::size_t to) {
      std::unique_ptr<TiffPartReader> reader = m_readers.take();
      const bool isRead = reader->isReady() && forParts(row + static_cast<int>(from), row + static_cast<int>(to),
                                                        [&](int plane, const TiffPart& part) {
                                                          return isWhole && readPart(*reader, plane, part, pixels);
                                                        });
      if (!isRead) isWhole = false;
      m_readers.giveBack(std::move(reader));
    });
    return isWhole;
  }

  bool readPart(TiffPartReader& reader, int plane, const TiffPart& part, std::uint8_t* pixels) const {
    const auto pixelBytes = static_cast<std::size_t>(m_layout.channels * m_layout.sampleBytes);
    const auto sampleBytes = static_cast<std::size_t>(m_layout.sampleBytes);
    const std::size_t lineBytes = static_cast<std::size_t>(m_layout.width) * pixelBytes;
    std::uint8_t* to = pixels + static_cast<std::size_t>(part.y) * lineBytes +
                       static_cast<std::size_t>(part.x) * pixelBytes + static_cast<std::size_t>(plane) * sampleBytes;
    if (!m_layout.isTiled && !m_layout.isSeparate) return reader.unpack(part, to);
    std::vector<std::uint8_t>& samples = reader.buffer();
    samples.resize(reader.bytesOf(part));
    if (!reader.unpack(part, samples.data())) return false;
    const std::size_t step = static_cast<std::size_t>(m_layout.partChannels()) * sampleBytes;
    for (int y = 0; y < part.height; ++y, to += lineBytes) {
      const std::uint8_t* from =
          samples.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(m_layout.partWidth) * step;
      if (!m_layout.isSeparate)
        std::memcpy(to, from, static_cast<std::size_t>(part.width) * pixelBytes);
      else
        for (std::size_t x = 0; x < static_cast<std::size_t>(part.width); ++x)
          std::memcpy(to + x * pixelBytes, from + x * sampleBytes, sampleBytes);
    }
    return true;
  }

  const TiffLayout& m_layout;
  TiffPartReaders m_readers;
};

// Division, not multiplication with a reciprocal: v/255 is exact where other programs are.
template <typename T> Image normalize(const BasicImage<T>& stored) {
  Image image;
  image.width = stored.width, image.height = stored.height, image.channels = stored.channels;
  image.pixels.reserve(stored.pixels.size());
  for (const T v : stored.pixels)
    image.pixels.push_back(static_cast<float>(v) / static_cast<float>(std::numeric_limits<T>::max()));
  return image;
}

} // namespace

std::optional<TiffPicture> readTiff(const std::filesystem::path& file, const ImageLimits& limits,
                                    std::size_t valueBytes, int channels) {
  std::optional<TiffLayout> layout;
  if (const TiffFile opened(file); opened.get()) layout = readTiffLayout(opened.get(), limits);
  if (!layout) return std::nullopt;
  const std::size_t handedOn = valueBytes * static_cast<std::size_t>(channels > 0 ? channels : layout->channels);
  const auto decoded = static_cast<std::size_t>(layout->sampleBytes * layout->channels);
  if (static_cast<std::size_t>(layout->width) * static_cast<std::size_t>(layout->height) * (handedOn + decoded) >
      limits.maxBytes)
    return std::nullopt;
  TiffPicture picture{layout->info, {}};
  TiffReading reading(file, *layout, limits);
  const auto read = [&](auto image) {
    if (image) picture.pixels = std::move(*image);
    return image.has_value();
  };
  const bool isRead = layout->sampleBytes == 1   ? read(reading.run<std::uint8_t>())
                      : layout->sampleBytes == 2 ? read(reading.run<std::uint16_t>())
                                                 : read(reading.run<float>());
  return isRead ? std::optional(std::move(picture)) : std::nullopt;
}

std::optional<ImageShape> readTiffShape(const std::filesystem::path& file, const ImageLimits& limits) {
  const TiffFile opened(file);
  if (!opened.get()) return std::nullopt;
  const std::optional<TiffLayout> layout = readTiffLayout(opened.get(), limits);
  if (!layout) return std::nullopt;
  return ImageShape{layout->width, layout->height, layout->channels, layout->info.integer};
}

Image toImage(TiffPicture&& picture) {
  if (auto* floats = std::get_if<Image>(&picture.pixels)) return std::move(*floats);
  if (const auto* wide = std::get_if<BasicImage<std::uint16_t>>(&picture.pixels)) return normalize(*wide);
  return normalize(std::get<Image8>(picture.pixels));
}

std::optional<Image8> toImage8(TiffPicture&& picture, int channels) {
  if (std::holds_alternative<Image>(picture.pixels)) return std::nullopt;
  const auto convert = [&](const auto& stored) {
    Image8 image(stored.width, stored.height, channels);
    ChannelMap(stored.channels, picture.info.alphaChannel, channels)
        .convert(stored.pixels.data(), stored.pixelCount(), image.pixels.data());
    return image;
  };
  if (const auto* wide = std::get_if<BasicImage<std::uint16_t>>(&picture.pixels)) return convert(*wide);
  Image8& bytes = std::get<Image8>(picture.pixels);
  return ChannelMap(bytes.channels, picture.info.alphaChannel, channels).keepsAll() ? std::move(bytes) : convert(bytes);
}

std::optional<BasicImage<std::uint32_t>> toIntegers(const TiffPicture& picture) {
  if (std::holds_alternative<Image>(picture.pixels)) return std::nullopt;
  BasicImage<std::uint32_t> image;
  const auto widen = [&](const auto& stored) {
    image.width = stored.width, image.height = stored.height, image.channels = stored.channels;
    image.pixels.assign(stored.pixels.begin(), stored.pixels.end());
  };
  std::visit(
      [&](const auto& stored) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(stored)>, Image>) widen(stored);
      },
      picture.pixels);
  return image;
}

} // namespace parity::base
