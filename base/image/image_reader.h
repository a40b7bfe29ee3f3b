// One image opened by OpenImageIO, from a file or from memory. Private to the module that holds the library.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image.h"
#include "base/image/image_limits.h"
#include "base/image/image_module.h"

namespace parity::base {

namespace oiio = OIIO;

// The first line of the library's own words in ASCII, less the file's name, which Error carries.
inline std::string reasonOf(std::string message, const std::string& path) {
  if (message.empty()) return "the image library reports no reason";
  const std::string quoted = "\"" + path + "\"";
  if (const std::size_t at = message.find(quoted); at != std::string::npos)
    message.replace(at, quoted.size(), "the file");
  message.resize(std::min(message.size(), message.find('\n')));
  for (char& c : message) // it may quote the file, whose bytes may be no text at all
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return message;
}

// The library's own reader of memory takes an offset before its beginning, which a file may ask for, as it is.
class Memory : public oiio::Filesystem::IOMemReader {
public:
  explicit Memory(std::span<const std::byte> bytes) : IOMemReader(bytes.data(), bytes.size()) {}

  std::size_t pread(void* to, std::size_t count, std::int64_t offset) override {
    return offset < 0 || offset >= static_cast<std::int64_t>(size()) ? 0 : IOMemReader::pread(to, count, offset);
  }
  std::size_t read(void* to, std::size_t count) override {
    const std::size_t got = pread(to, count, tell());
    m_pos += static_cast<std::int64_t>(got);
    return got;
  }
  bool seek(std::int64_t offset) override { return offset >= 0 && IOMemReader::seek(offset); }
};

// One opened image whose size has been checked.
class Reader {
public:
  // Only the reader of this format is tried: others may take almost any bytes for theirs, or look for other files.
  explicit Reader(const ImageSource& source) : m_name(source.name) {
    oiio::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1); // textures and pictures as stored, not multiplied by alpha
    m_input = oiio::ImageInput::create(source.format);
    if (!m_input) throw fileError(m_name, "cannot be decoded", reasonOf(oiio::geterror(), m_name));
    if (!source.bytes.empty()) {
      m_memory = std::make_unique<Memory>(source.bytes);
      oiio::Filesystem::IOProxy* proxy = m_memory.get();
      config.attribute("oiio:ioproxy", oiio::TypeDesc::PTR, &proxy);
      if (!m_input->supports("ioproxy"))
        throw fileError(m_name, "cannot be decoded",
                        std::string("the image library reads no ") + source.format + " from memory");
    }
    if (!m_input->open(m_name, spec, config))
      throw fileError(m_name, "cannot be decoded", reasonOf(m_input->geterror(), m_name));
    check(source.limits);
  }

  const oiio::ImageSpec& spec() const { return m_input->spec(); }

  ImageShape shape() const {
    const oiio::ImageSpec& spec = m_input->spec();
    return {spec.width, spec.height, spec.nchannels, !spec.format.is_floating_point()};
  }

  ImageInfo info() const {
    const oiio::ImageSpec& spec = m_input->spec();
    ImageInfo info;
    info.integer = !spec.format.is_floating_point();
    info.bits = static_cast<int>(spec.format.size()) * 8;
    info.channelNames = spec.channelnames;
    info.alphaChannel = spec.alpha_channel;
    // Of the integer formats only TIFF tells the two apart; the others leave alpha out of the colour.
    const bool tells = std::string_view(m_input->format_name()) == "tiff";
    info.alphaAssociated =
        spec.alpha_channel >= 0 && (!info.integer || tells) && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
    info.declaredLinear = oiio::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear");
    std::array<float, 8> chromaticities{};
    if (spec.getattribute("chromaticities", oiio::TypeDesc(oiio::TypeDesc::FLOAT, 8), chromaticities.data()))
      info.chromaticities = chromaticities;
    info.x = spec.x, info.y = spec.y;
    info.fullX = spec.full_x, info.fullY = spec.full_y;
    info.fullWidth = spec.full_width, info.fullHeight = spec.full_height;
    info.isCubeMap = spec.get_string_attribute("textureformat") == "CubeFace Environment";
    info.orientation = spec.get_int_attribute("Orientation", 1);
    return info;
  }

  // To be called last: the reader then is past the first image.
  int countImages() {
    int count = 1;
    while (count < kMaxCountedImages && m_input->seek_subimage(count, 0)) ++count;
    m_input->geterror(); // that there is no further one is no error
    return count;
  }

  // Throws Error (exit 4) where handing on the image takes more than the limit: valueBytes for each of so many
  // channels, beside what decoding takes.
  void requireMemory(std::size_t valueBytes, int channels, const ImageLimits& limits) const {
    const oiio::ImageSpec& spec = m_input->spec();
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    const std::size_t bytes = pixels * (valueBytes * static_cast<std::size_t>(channels) +
                                        decodingBytes() * static_cast<std::size_t>(spec.nchannels));
    checkImageBytes(m_name, fmt::format("an image of {} x {} pixels", spec.width, spec.height), bytes, limits.maxBytes);
  }

  template <typename T> BasicImage<T> read() {
    const oiio::ImageSpec& spec = m_input->spec();
    BasicImage<T> image;
    image.width = spec.width, image.height = spec.height, image.channels = spec.nchannels;
    image.pixels.reserve(image.pixelCount() * static_cast<std::size_t>(spec.nchannels));
    for (int y = 0; y < spec.height; y += bandLines()) {
      const std::size_t before = image.pixels.size(), more = valuesFrom(y);
      image.pixels.resize(before + more);
      readBand(y, std::span(image.pixels).subspan(before));
    }
    return image;
  }

  // take(std::span<const T>): some lines of all channels, from the top on.
  template <typename T, typename Take> void readBands(const Take& take) {
    std::vector<T> band(valuesFrom(0));
    for (int y = 0; y < m_input->spec().height; y += bandLines()) {
      const auto lines = std::span(band).first(valuesFrom(y));
      readBand(y, lines);
      take(std::span<const T>(lines));
    }
  }

private:
  // What the library itself may hold of a value while it decodes: the coefficients of a progressive JPEG are 16 bit;
  // interlaced PNG, tiles, and strips as high as the picture are decoded as a whole; lines and bands are not.
  std::size_t decodingBytes() const {
    const std::string_view format = m_input->format_name();
    if (format == "jpeg") return 2;
    if (format == "hdr" || (format == "openexr" && m_input->spec().tile_width == 0)) return 0;
    return m_input->spec().format.size();
  }
  // In bands: a file that ends early has memory touched for no more than it holds. No format packs more lines together.
  int bandLines() const { return m_input->spec().tile_width ? m_input->spec().height : 256; }
  // Of the band that begins at line y.
  std::size_t valuesFrom(int y) const {
    const oiio::ImageSpec& spec = m_input->spec();
    return static_cast<std::size_t>(std::min(bandLines(), spec.height - y)) * static_cast<std::size_t>(spec.width) *
           static_cast<std::size_t>(spec.nchannels);
  }
  template <typename T> void readBand(int y, std::span<T> to) {
    const oiio::ImageSpec& spec = m_input->spec();
    const auto type = oiio::BaseTypeFromC<T>::value;
    const int end = std::min(spec.height, y + bandLines());
    const bool whole = spec.tile_width ? m_input->read_image(0, 0, 0, spec.nchannels, type, to.data())
                                       : m_input->read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0,
                                                                 spec.nchannels, type, to.data());
    // Some readers fill the rest of a truncated file and only leave a message.
    if (!whole || m_input->has_error())
      throw fileError(m_name, "damaged or truncated", reasonOf(m_input->geterror(), m_name));
  }

  void check(const ImageLimits& limits) const {
    const oiio::ImageSpec& spec = m_input->spec();
    checkImageSize(m_name, spec.width, spec.height, spec.nchannels, limits);
    if (spec.nchannels > kMaxImageChannels)
      throw fileError(m_name, "",
                      fmt::format("has {} channels, expected at most {}", spec.nchannels, kMaxImageChannels));
    if (spec.depth > 1 || spec.deep) throw fileError(m_name, "", "is a volume or a deep image; give a flat image");
    // Unpacking the bits of CMYK, the library (2.4) counts three channels where four are stored, and writes too far.
    constexpr int kSeparated = 5; // TIFF 6.0, PhotometricInterpretation
    if (spec.get_int_attribute("tiff:PhotometricInterpretation") == kSeparated &&
        spec.get_int_attribute("oiio:BitsPerSample", 8) % 8 != 0)
      throw fileError(m_name, "cannot be decoded", "CMYK with less than 8 bits is not supported");
  }

  std::string m_name;
  std::unique_ptr<Memory> m_memory; // outlives the input
  oiio::ImageInput::unique_ptr m_input;
};

} // namespace parity::base
