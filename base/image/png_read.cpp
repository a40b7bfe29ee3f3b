// What a PNG file says of itself by libpng, its rows by libdeflate, or by libpng where they are unusual.
#include "base/image/png_read.h"

#include <strings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <vector>

#include <png.h>

#include "base/image/channel_map.h"
#include "base/image/png_inflate.h"

namespace parity::base {

namespace {

// The file, as libpng reads it.
struct Input {
  std::span<const std::byte> rest;
};

// libpng jumps over frames: they hold nothing that has a destructor.
[[noreturn]] void fail(png_structp png, const char* /*reason*/) { png_longjmp(png, 1); }

void ignoreWarning(png_structp /*png*/, const char* /*reason*/) {}

void read(png_structp png, png_bytep to, std::size_t size) {
  auto* input = static_cast<Input*>(png_get_io_ptr(png));
  if (size > input->rest.size()) png_error(png, "the file ends");
  std::memcpy(to, input->rest.data(), size);
  input->rest = input->rest.subspan(size);
}

// As the image library has its samples: of 8 or 16 bits, with the alpha that tRNS means.
bool readHeader(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  png_set_expand(png);
  png_read_update_info(png, info);
  return true;
}

bool readRows(png_structp png, png_bytepp rows, png_uint_32 height, bool isInterlaced) {
  if (setjmp(png_jmpbuf(png))) return false;
  if (isInterlaced) {
    png_read_image(png, rows);
    png_read_end(png, nullptr);
  } else {
    for (png_uint_32 y = 0; y < height; ++y) png_read_row(png, rows[y], nullptr);
  }
  return true;
}

// Owns both structs of libpng.
class Decoder {
public:
  explicit Decoder(std::span<const std::byte> bytes) : m_input{bytes} {
    m_png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignoreWarning);
    if (!m_png) return;
    m_info = png_create_info_struct(m_png);
    png_set_read_fn(m_png, &m_input, read);
  }
  ~Decoder() { png_destroy_read_struct(&m_png, &m_info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  bool isReady() const { return m_png && m_info; }
  png_structp png() const { return m_png; }
  png_infop info() const { return m_info; }

private:
  Input m_input;
  png_structp m_png = nullptr;
  png_infop m_info = nullptr;
};

// The image library takes a text chunk for an attribute of its name, in any case of letters.
bool isNamed(const png_text& text, const char* name) { return strcasecmp(text.key, name) == 0; }

std::span<const png_text> textsOf(png_structp png, png_infop info) {
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  return {texts, static_cast<std::size_t>(std::max(count, 0))};
}

bool hasText(png_structp png, png_infop info, std::span<const char* const> names) {
  const std::span<const png_text> texts = textsOf(png, info);
  return std::any_of(texts.begin(), texts.end(), [&](const png_text& text) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return isNamed(text, name); });
  });
}

// By these the library refuses a picture, or describes it; the samples it reads whatever they say.
bool needsLibrary(png_structp png, png_infop info, PngUse use) {
  constexpr std::array kRefusing{"tiff:PhotometricInterpretation", "oiio:BitsPerSample"};
  constexpr std::array kDescribing{"Orientation", "chromaticities", "textureformat", "XML:com.adobe.xmp",
                                   "Raw profile type exif"};
  png_uint_32 exifBytes = 0;
  png_bytep exif = nullptr;
  return hasText(png, info, kRefusing) || (use == PngUse::described && (hasText(png, info, kDescribing) ||
                                                                        png_get_eXIf_1(png, info, &exifBytes, &exif)));
}

bool isDeclaredLinear(png_structp png, png_infop info) {
  const char* text = nullptr; // the last one counts, and more than what the header's chunks say
  for (const png_text& each : textsOf(png, info))
    if (isNamed(each, "oiio:ColorSpace")) text = each.text;
  if (text) return strcasecmp(text, "linear") == 0;
  int intent = 0;
  double gamma = 0;
  if (png_get_sRGB(png, info, &intent) || !png_get_gAMA(png, info, &gamma) || !(gamma > 0)) return false;
  return std::round(100.0f * static_cast<float>(1.0 / gamma)) / 100.0f == 1.0f;
}

ImageInfo describe(png_structp png, png_infop info, int channels) {
  ImageInfo result;
  result.integer = true;
  result.bits = png_get_bit_depth(png, info);
  result.channelNames = channels > 2 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  if (channels % 2 == 0) {
    result.channelNames.emplace_back("A");
    result.alphaChannel = channels - 1;
  }
  result.declaredLinear = isDeclaredLinear(png, info);
  result.x = png_get_x_offset_pixels(png, info), result.y = png_get_y_offset_pixels(png, info);
  result.fullWidth = static_cast<int>(png_get_image_width(png, info));
  result.fullHeight = static_cast<int>(png_get_image_height(png, info));
  return result;
}

std::uint16_t load16(const std::uint8_t* bytes) { return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]); }

// Row by row, so that a picture is not filled with zeros before: make(row, its values, where to put them).
template <typename T, typename Make> BasicImage<T> convert(const PngSamples& samples, int channels, const Make& make) {
  BasicImage<T> image;
  image.width = samples.width, image.height = samples.height, image.channels = channels;
  const std::size_t count = static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(channels);
  image.pixels.reserve(count * static_cast<std::size_t>(samples.height));
  for (int y = 0; y < samples.height; ++y) {
    const std::size_t before = image.pixels.size();
    image.pixels.resize(before + count);
    make(samples.row(y), count, image.pixels.data() + before);
  }
  return image;
}

} // namespace

std::optional<PngSamples> readPng(std::span<const std::byte> bytes, PngUse use, std::size_t maxBytes,
                                  std::size_t valueBytes, int channels) {
  const Decoder decoder(bytes);
  if (!decoder.isReady() || !readHeader(decoder.png(), decoder.info())) return std::nullopt;
  png_structp png = decoder.png();
  png_infop info = decoder.info();
  if (needsLibrary(png, info, use)) return std::nullopt;

  PngSamples samples;
  samples.width = static_cast<int>(png_get_image_width(png, info));
  samples.height = static_cast<int>(png_get_image_height(png, info));
  samples.channels = png_get_channels(png, info);
  samples.info = describe(png, info, samples.channels);
  const int sampleBytes = samples.info.bits / 8;
  const auto height = static_cast<std::size_t>(samples.height);
  const std::size_t rowBytes = png_get_rowbytes(png, info), pixels = height * static_cast<std::size_t>(samples.width);
  const auto wanted = static_cast<std::size_t>(channels ? channels : samples.channels);
  if (pixels * wanted * valueBytes + height * rowBytes > maxBytes) return std::nullopt;

  // Not touched before there is something to write: a file that ends early takes no memory for the rest.
  samples.rowBytes = 1 + rowBytes;
  samples.first = 1;
  samples.bytes = std::make_unique_for_overwrite<std::uint8_t[]>(height * samples.rowBytes);
  const std::span rows(samples.bytes.get(), height * samples.rowBytes);
  const bool isInterlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
  // The header as it is stored tells whether the rows lie in the file as they are wanted.
  const auto depth = static_cast<int>(bytes[24]), colorType = static_cast<int>(bytes[25]);
  constexpr std::array kChannels{1, 0, 3, 0, 2, 0, 4};
  if (!isInterlaced && depth == samples.info.bits &&
      kChannels[static_cast<std::size_t>(colorType)] == samples.channels &&
      inflatePngRows(bytes, rows, rowBytes, samples.channels * sampleBytes))
    return samples;
  std::vector<png_bytep> starts(height);
  for (std::size_t y = 0; y < height; ++y) starts[y] = rows.data() + 1 + y * samples.rowBytes;
  if (!readRows(png, starts.data(), static_cast<png_uint_32>(height), isInterlaced)) return std::nullopt;
  return samples;
}

Image toImage(const PngSamples& samples) {
  // Division, not multiplication with a reciprocal: v/255 is exact where other programs are.
  std::array<float, 256> shares;
  for (std::size_t v = 0; v < shares.size(); ++v) shares[v] = static_cast<float>(v) / 255.0f;
  if (samples.info.bits == 8)
    return convert<float>(samples, samples.channels, [&](const std::uint8_t* row, std::size_t count, float* to) {
      for (std::size_t i = 0; i < count; ++i) to[i] = shares[row[i]];
    });
  return convert<float>(samples, samples.channels, [](const std::uint8_t* row, std::size_t count, float* to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(load16(row + 2 * i)) / 65535.0f;
  });
}

Image8 toImage8(const PngSamples& samples, int channels) {
  const ChannelMap map(samples.channels, samples.info.alphaChannel, channels);
  const auto width = static_cast<std::size_t>(samples.width);
  if (samples.info.bits == 8)
    return convert<std::uint8_t>(samples, channels, [&](const std::uint8_t* row, std::size_t count, std::uint8_t* to) {
      if (map.keepsAll())
        std::memcpy(to, row, count);
      else
        map.convert(row, width, to);
    });
  std::vector<std::uint16_t> wide(width * static_cast<std::size_t>(samples.channels));
  return convert<std::uint8_t>(samples, channels, [&](const std::uint8_t* row, std::size_t, std::uint8_t* to) {
    for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = load16(row + 2 * i);
    map.convert(wide.data(), width, to);
  });
}

Image8 toImage8(const PngSamples& samples) {
  return convert<std::uint8_t>(
      samples, samples.channels,
      [](const std::uint8_t* row, std::size_t count, std::uint8_t* to) { std::memcpy(to, row, count); });
}

BasicImage<std::uint32_t> toIntegers(const PngSamples& samples) {
  const bool isWide = samples.info.bits == 16;
  return convert<std::uint32_t>(samples, samples.channels,
                                [&](const std::uint8_t* row, std::size_t count, std::uint32_t* to) {
                                  for (std::size_t i = 0; i < count; ++i) to[i] = isWide ? load16(row + 2 * i) : row[i];
                                });
}

} // namespace parity::base
