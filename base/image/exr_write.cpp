// Chunks are packed and compressed on all cores, then stored in their order.
#include "base/image/exr_write.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <libdeflate.h>
#include <openexr.h>

#include "base/error.h"
#include "base/parallel.h"

namespace parity::base {

namespace {

constexpr std::size_t kLongestShortName = 31; // longer ones need a flag of the file
constexpr std::size_t kTableBytes = 8;        // of a chunk's place in the file, and of the head of a chunk

// What the library said was wrong. Its callback gets the file, but asking the file for its user's data would wait for
// a lock that the library holds. All its calls for one file are made by one thread.
thread_local std::string t_failure;

std::int64_t write(exr_const_context_t /*file*/, void* user, const void* from, std::uint64_t size, std::uint64_t offset,
                   exr_stream_error_func_ptr_t /*fail*/) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(user);
  try {
    if (bytes.size() < offset + size) bytes.resize(offset + size);
  } catch (const std::bad_alloc&) { // not through the library
    t_failure = "out of memory";
    return -1;
  }
  if (size > 0) std::memcpy(bytes.data() + offset, from, size);
  return static_cast<std::int64_t>(size);
}

void keepFirst(exr_const_context_t /*file*/, exr_result_t /*code*/, const char* message) {
  if (t_failure.empty()) t_failure = message;
}

std::vector<std::string> namesOf(const Image& image, const WriteOptions& options) {
  if (!options.channelNames.empty()) return options.channelNames;
  if (image.channels == 1) return {"Y"};
  if (image.channels == 2) return {"Y", "A"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  names.resize(static_cast<std::size_t>(std::min(image.channels, 4)));
  for (int i = 4; i < image.channels; ++i) names.push_back(fmt::format("channel{}", i));
  return names;
}

static_assert(std::endian::native == std::endian::little); // as the file has its values

// The nearest half, of two the even one; from 65520 on infinite. A NaN keeps its sign and upper bits (F. Giesen,
// "half->float variants", float_to_half, 2012).
std::uint16_t toHalf(float v) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(v), sign = bits >> 16 & 0x8000u, size = bits & 0x7fffffffu;
  std::uint32_t half;
  if (size > 0x7f800000u) // NaN: at least one bit tells it from infinity
    half = 0x7c00u | std::max(size >> 13 & 0x3ffu, 1u);
  else if (size >= 0x477ff000u) // 65520
    half = 0x7c00u;
  else if (size < 0x38800000u) // 2^-14: at .5 floats are as far apart as subnormal halves are, so adding it rounds
    half = std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5f) - 0x3f000000u;
  else // the exponent from base 127 to base 15; half a unit less a bit, and that bit where the last one is odd
    half = (size - (112u << 23) + 0xfffu + (size >> 13 & 1u)) >> 13;
  return static_cast<std::uint16_t>(sign | half);
}

// ZIP of OpenEXR ("OpenEXR File Layout"; the core library compresses only one chunk after another): first the bytes at
// even places, then the others; of each its difference from the one before, plus 128; then zlib. As it was where that
// is no smaller.
std::vector<std::byte> compress(const std::vector<std::byte>& raw) {
  constexpr int kLevel = 4; // libdeflate's, of 1 to 12
  std::vector<std::uint8_t> split(raw.size());
  const std::size_t half = (raw.size() + 1) / 2;
  for (std::size_t i = 0; i < raw.size(); ++i) split[i / 2 + (i % 2) * half] = static_cast<std::uint8_t>(raw[i]);
  for (std::size_t i = split.size() - 1; i > 0; --i)
    split[i] = static_cast<std::uint8_t>(split[i] - split[i - 1] + 128);
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> packed(raw.size() - 1); // 0 bytes come back where it does not fit
  const std::size_t size =
      libdeflate_zlib_compress(compressor.get(), split.data(), split.size(), packed.data(), packed.size());
  if (size == 0) return raw;
  return {packed.data(), packed.data() + size}; // no more memory than that: all chunks are held until the last is made
}

class ExrWriter {
public:
  ExrWriter(const Image& image, const WriteOptions& options, std::string name)
      : m_image(image), m_isHalf(options.half), m_name(std::move(name)), m_channels(namesOf(image, options)) {
    for (std::size_t i = 0; i < m_channels.size(); ++i) m_places[m_channels[i]] = i;
    t_failure.clear();
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = keepFirst;
    start.user_data = &m_bytes;
    start.write_fn = write;
    check(exr_start_write(&m_file, m_name.c_str(), EXR_WRITE_FILE_DIRECTLY, &start));
  }
  ~ExrWriter() {
    if (m_file) exr_finish(&m_file);
  }
  ExrWriter(const ExrWriter&) = delete;
  ExrWriter& operator=(const ExrWriter&) = delete;

  std::vector<std::byte> encode() {
    writeHeader();
    std::int32_t lines = 0;
    check(exr_get_scanlines_per_chunk(m_file, 0, &lines));
    const int count = (m_image.height + lines - 1) / lines;
    std::vector<std::vector<std::byte>> chunks(static_cast<std::size_t>(count));
    parallelFor(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int line = static_cast<int>(i) * lines;
        chunks[i] = pack(line, std::min(lines, m_image.height - line));
      }
    });
    std::size_t size = m_bytes.size() + kTableBytes * chunks.size();
    for (const std::vector<std::byte>& chunk : chunks) size += chunk.size() + kTableBytes;
    m_bytes.reserve(size);
    for (int i = 0; i < count; ++i) {
      std::vector<std::byte>& chunk = chunks[static_cast<std::size_t>(i)];
      check(exr_write_scanline_chunk(m_file, 0, i * lines, chunk.data(), chunk.size()));
      std::vector<std::byte>().swap(chunk);
    }
    check(exr_finish(&m_file));
    return std::move(m_bytes);
  }

private:
  // The library's own words where it has some.
  void check(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS)
      throw fileError(m_name, "cannot be written",
                      t_failure.empty() ? exr_get_default_error_message(result) : t_failure);
  }

  void writeHeader() {
    if (std::any_of(m_channels.begin(), m_channels.end(), [](const auto& n) { return n.size() > kLongestShortName; }))
      check(exr_set_longname_support(m_file, 1));
    int part = 0;
    check(exr_add_part(m_file, "", EXR_STORAGE_SCANLINE, &part));
    check(exr_initialize_required_attr_simple(m_file, part, m_image.width, m_image.height, EXR_COMPRESSION_ZIP));
    for (const std::string& channel : m_channels)
      check(exr_add_channel(m_file, part, channel.c_str(), m_isHalf ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    check(exr_write_header(m_file));
  }

  // A chunk as the file has it: line by line, of each channel in order of the names its samples.
  std::vector<std::byte> pack(int line, int lines) const {
    const std::size_t channels = m_channels.size(), width = static_cast<std::size_t>(m_image.width);
    std::vector<std::byte> raw(static_cast<std::size_t>(lines) * width * channels * (m_isHalf ? 2 : 4));
    std::byte* to = raw.data();
    for (int y = line; y < line + lines; ++y)
      for (const auto& [name, place] : m_places) {
        const float* from = m_image.pixels.data() + static_cast<std::size_t>(y) * width * channels + place;
        for (std::size_t x = 0; x < width; ++x, from += channels)
          if (m_isHalf) {
            const std::uint16_t half = toHalf(*from);
            std::memcpy(to, &half, sizeof(half)), to += sizeof(half);
          } else
            std::memcpy(to, from, sizeof(float)), to += sizeof(float);
      }
    return compress(raw);
  }

  const Image& m_image;
  bool m_isHalf;
  std::string m_name;
  std::vector<std::string> m_channels;
  std::map<std::string, std::size_t> m_places; // of a pixel's channels, sorted as the file has them
  std::vector<std::byte> m_bytes;
  exr_context_t m_file = nullptr;
};

} // namespace

std::vector<std::byte> encodeExr(const Image& image, const WriteOptions& options, const std::string& name) {
  try {
    return ExrWriter(image, options, name).encode();
  } catch (const std::bad_alloc&) {
    throw fileError(name, "", "out of memory");
  }
}

} // namespace parity::base
