// OpenEXR by its core library, chunk by chunk on all cores.
#include "base/image/exr_read.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>

#include "base/image/exr_header.h"
#include "base/parallel.h"

namespace parity::base {

namespace {

constexpr int kBandLines = 256; // a file that ends early has memory touched for no more than it holds

struct Source {
  std::span<const std::byte> head; // or all
  std::size_t fileBytes;
};

std::int64_t read(exr_const_context_t /*file*/, void* user, void* to, std::uint64_t size, std::uint64_t offset,
                  exr_stream_error_func_ptr_t /*fail*/) {
  const std::span<const std::byte> bytes = static_cast<const Source*>(user)->head;
  if (offset > bytes.size()) return -1;
  const std::size_t count = std::min<std::size_t>(size, bytes.size() - offset); // of a header it asks for 4 KiB
  std::memcpy(to, bytes.data() + offset, count);
  return static_cast<std::int64_t>(count);
}

std::int64_t sizeOf(exr_const_context_t /*file*/, void* user) {
  return static_cast<std::int64_t>(static_cast<const Source*>(user)->fileBytes);
}

// The image library says what is wrong.
void ignore(exr_const_context_t /*file*/, exr_result_t /*code*/, const char* /*message*/) {}

class ExrFile {
public:
  explicit ExrFile(const Source& source) : m_source(source) {
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = ignore;
    start.user_data = &m_source;
    start.read_fn = read;
    start.size_fn = sizeOf;
    start.flags = EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE |
                  EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    if (exr_start_read(&m_file, "memory", &start) != EXR_ERR_SUCCESS) m_file = nullptr;
  }
  ~ExrFile() {
    if (m_file) exr_finish(&m_file);
  }
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;

  exr_const_context_t get() const { return m_file; }

private:
  Source m_source;
  exr_context_t m_file = nullptr;
};

// Unpacks chunks, one after another, with the same buffers.
class ChunkReader {
public:
  explicit ChunkReader(exr_const_context_t file) : m_file(file) {}
  ~ChunkReader() {
    if (m_isReady) exr_decoding_destroy(m_file, &m_pipeline);
  }
  ChunkReader(const ChunkReader&) = delete;
  ChunkReader& operator=(const ChunkReader&) = delete;

  // Line by line, of each channel its samples. Nothing where the chunk is damaged.
  std::span<const std::byte> unpack(const exr_chunk_info_t& chunk) {
    // Of these the core library would leave its buffer as it is.
    const bool isPlain = chunk.compression == EXR_COMPRESSION_NONE;
    if (chunk.packed_size == 0 || (isPlain && chunk.packed_size != chunk.unpacked_size)) return {};
    if (!prepare(chunk) || exr_decoding_run(m_file, 0, &m_pipeline) != EXR_ERR_SUCCESS) return {};
    if (!m_pipeline.unpacked_buffer) return {};
    return {static_cast<const std::byte*>(m_pipeline.unpacked_buffer), static_cast<std::size_t>(chunk.unpacked_size)};
  }

private:
  bool prepare(const exr_chunk_info_t& chunk) {
    if (m_isReady) return exr_decoding_update(m_file, 0, &chunk, &m_pipeline) == EXR_ERR_SUCCESS;
    if (exr_decoding_initialize(m_file, 0, &chunk, &m_pipeline) != EXR_ERR_SUCCESS) return false;
    m_isReady = true;
    if (exr_decoding_choose_default_routines(m_file, 0, &m_pipeline) != EXR_ERR_SUCCESS) return false;
    m_pipeline.unpack_and_convert_fn = nullptr; // this program does it, for any order of the channels
    return true;
  }

  exr_const_context_t m_file;
  exr_decode_pipeline_t m_pipeline{};
  bool m_isReady = false;
};

// Without branches, and every NaN keeps its bits (F. Giesen, "half->float variants", half_to_float_fast, 2012).
float fromHalf(std::uint16_t half) {
  const std::uint32_t shifted = (half & 0x7fffu) << 13, sign = (half & 0x8000u) << 16;
  const float scaled = std::bit_cast<float>(shifted) * 0x1p112f;
  const std::uint32_t finite = std::bit_cast<std::uint32_t>(scaled), special = shifted | 0x7f800000u;
  return std::bit_cast<float>((shifted >= 0x7c00u << 13 ? special : finite) | sign);
}

// The chunk's samples to their place in the picture, whose first pixel is at `to`.
bool store(const ExrHeader& header, std::span<const std::byte> samples, const exr_chunk_info_t& chunk, float* to) {
  const std::size_t channels = header.channels.size(), stride = static_cast<std::size_t>(header.width) * channels;
  const auto width = static_cast<std::size_t>(chunk.width), height = static_cast<std::size_t>(chunk.height);
  std::size_t pixelBytes = 0;
  for (const ExrHeader::Channel& channel : header.channels) pixelBytes += channel.isHalf ? 2 : 4;
  if (samples.size() != width * height * pixelBytes) return false;
  const std::byte* from = samples.data();
  for (std::size_t y = 0; y < height; ++y)
    for (const ExrHeader::Channel& channel : header.channels) {
      float* out = to + y * stride + static_cast<std::size_t>(channel.place);
      for (std::size_t x = 0; x < width; ++x, out += channels) {
        if (channel.isHalf) {
          std::uint16_t half = 0;
          std::memcpy(&half, from + 2 * x, 2);
          *out = fromHalf(half);
        } else {
          std::memcpy(out, from + 4 * x, 4);
        }
      }
      from += width * (channel.isHalf ? 2 : 4);
    }
  return true;
}

class Reading {
public:
  Reading(exr_const_context_t file, const ExrHeader& header) : m_file(file), m_header(header) {
    m_image.width = header.width, m_image.height = header.height;
    m_image.channels = static_cast<int>(header.channels.size());
  }

  // False where the image library has to read it.
  bool run() {
    if (!findLayout()) return false;
    m_image.pixels.reserve(static_cast<std::size_t>(m_header.height) * lineValues());
    const int band = std::max(1, kBandLines / m_chunkHeight); // rows of chunks
    for (int row = 0; row * m_chunkHeight < m_header.height; row += band) {
      const int bottom = std::min((row + band) * m_chunkHeight, m_header.height);
      m_image.pixels.resize(static_cast<std::size_t>(bottom) * lineValues());
      const int first = row * m_across, end = std::min(first + band * m_across, m_count);
      std::atomic<bool> isWhole = true;
      parallelFor(static_cast<std::size_t>(end - first), 4, [&](std::size_t from, std::size_t to) {
        ChunkReader reader(m_file);
        for (std::size_t i = from; i < to && isWhole; ++i)
          if (!readChunk(first + static_cast<int>(i), reader)) isWhole = false;
      });
      if (!isWhole) return false;
    }
    return true;
  }

  Image take() { return std::move(m_image); }

  // Whether the table of the chunks is whole, which the image library reads when it opens a file.
  bool hasChunks() {
    exr_chunk_info_t chunk{};
    Place place;
    return findLayout() && findChunk(0, chunk, place);
  }

private:
  std::size_t lineValues() const { return static_cast<std::size_t>(m_header.width) * m_header.channels.size(); }
  float* at(int x, int y) {
    return m_image.pixels.data() + static_cast<std::size_t>(y) * lineValues() +
           static_cast<std::size_t>(x) * m_header.channels.size();
  }

  struct Place {
    int x = 0, y = 0, width = 0, height = 0; // of a chunk, from the data window's corner
  };

  // What the file says of chunk i; false where it does not fit.
  bool findChunk(int i, exr_chunk_info_t& chunk, Place& place) const {
    const int column = i % m_across, row = i / m_across;
    place.x = column * m_chunkWidth, place.y = row * m_chunkHeight;
    place.width = std::min(m_chunkWidth, m_header.width - place.x);
    place.height = std::min(m_chunkHeight, m_header.height - place.y);
    const exr_result_t found = m_header.isTiled
                                   ? exr_read_tile_chunk_info(m_file, 0, column, row, 0, 0, &chunk)
                                   : exr_read_scanline_chunk_info(m_file, 0, m_header.info.y + place.y, &chunk);
    return found == EXR_ERR_SUCCESS && chunk.width == place.width && chunk.height == place.height;
  }

  // The image library reads on where a chunk has ended, wherever the next one is said to begin.
  bool isFollowed(int i, const exr_chunk_info_t& chunk) const {
    const std::uint64_t headBytes = m_header.isTiled ? 20 : 8;
    exr_chunk_info_t next{};
    Place place;
    return i + 1 == m_count ||
           (findChunk(i + 1, next, place) && chunk.data_offset + chunk.packed_size + headBytes == next.data_offset);
  }

  bool readChunk(int i, ChunkReader& reader) {
    exr_chunk_info_t chunk{};
    Place place;
    return findChunk(i, chunk, place) && isFollowed(i, chunk) &&
           store(m_header, reader.unpack(chunk), chunk, at(place.x, place.y));
  }

  bool findLayout() {
    std::uint32_t width = static_cast<std::uint32_t>(m_header.width), height = 0;
    exr_tile_level_mode_t levels{};
    exr_tile_round_mode_t round{};
    std::int32_t lines = 0;
    if (m_header.isTiled) {
      if (exr_get_tile_descriptor(m_file, 0, &width, &height, &levels, &round) != EXR_ERR_SUCCESS) return false;
    } else {
      if (exr_get_scanlines_per_chunk(m_file, 0, &lines) != EXR_ERR_SUCCESS || lines < 1) return false;
      height = static_cast<std::uint32_t>(lines);
    }
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) return false;
    m_chunkWidth = static_cast<int>(width), m_chunkHeight = static_cast<int>(height);
    m_across = (m_header.width + m_chunkWidth - 1) / m_chunkWidth;
    m_count = m_across * ((m_header.height + m_chunkHeight - 1) / m_chunkHeight);
    return true;
  }

  exr_const_context_t m_file;
  const ExrHeader& m_header;
  int m_chunkWidth = 0, m_chunkHeight = 0, m_across = 0, m_count = 0;
  Image m_image;
};

} // namespace

std::optional<ImageFile> readExr(std::span<const std::byte> bytes, const ImageLimits& limits) {
  const ExrFile file({bytes, bytes.size()});
  if (!file.get()) return std::nullopt;
  const std::optional<ExrHeader> header = readExrHeader(file.get(), limits);
  if (!header) return std::nullopt;
  Reading reading(file.get(), *header);
  if (!reading.run()) return std::nullopt;
  return ImageFile{reading.take(), header->info};
}

std::optional<ImageShape> readExrShape(std::span<const std::byte> head, std::size_t fileBytes,
                                       const ImageLimits& limits) {
  const ExrFile file({head, fileBytes});
  if (!file.get()) return std::nullopt;
  ImageLimits shapeOnly = limits;
  shapeOnly.maxBytes = ImageLimits{}.maxBytes;
  const std::optional<ExrHeader> header = readExrHeader(file.get(), shapeOnly);
  if (!header || !Reading(file.get(), *header).hasChunks()) return std::nullopt;
  return ImageShape{header->width, header->height, static_cast<int>(header->channels.size()), false};
}

} // namespace parity::base
