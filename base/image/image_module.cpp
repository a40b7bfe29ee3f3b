// The module that holds OpenImageIO: image files of every kind to and from memory.
#include "base/image/image_module.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/image/channel_map.h"
#include "base/image/image_reader.h"

namespace parity::base {

namespace {

namespace fs = std::filesystem;

// Whatever the library throws becomes an Error that names the file.
template <typename Body> auto guarded(const std::string& name, Body&& body) {
  try {
    return body();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw fileError(name, "", "out of memory");
  } catch (const std::exception& error) {
    throw fileError(name, "", reasonOf(error.what(), name));
  }
}

// Division, not multiplication with a reciprocal: v/255 is exact where other programs are. Band by band: of a large
// picture we hold no second copy.
template <typename T> Image readNormalized(Reader& reader) {
  const oiio::ImageSpec spec = reader.spec();
  Image image;
  image.width = spec.width, image.height = spec.height, image.channels = spec.nchannels;
  image.pixels.reserve(image.pixelCount() * static_cast<std::size_t>(spec.nchannels));
  reader.readBands<T>([&](std::span<const T> band) {
    for (const T v : band)
      image.pixels.push_back(static_cast<float>(v) / static_cast<float>(std::numeric_limits<T>::max()));
  });
  return image;
}

// Band by band: of a large picture stored in scanlines we hold no second copy.
template <typename T> Image8 convertWhileReading(Reader& reader, const ChannelMap& map, int channels) {
  const oiio::ImageSpec spec = reader.spec();
  Image8 image;
  image.width = spec.width, image.height = spec.height, image.channels = channels;
  image.pixels.reserve(image.pixelCount() * static_cast<std::size_t>(channels));
  reader.readBands<T>([&](std::span<const T> band) {
    const std::size_t count = band.size() / static_cast<std::size_t>(spec.nchannels), before = image.pixels.size();
    image.pixels.resize(before + count * static_cast<std::size_t>(channels));
    map.convert(band.data(), count, image.pixels.data() + before);
  });
  return image;
}

Image8 readAs8(Reader& reader, int channels) {
  const ChannelMap map(reader.spec().nchannels, reader.spec().alpha_channel, channels);
  if (reader.spec().format == oiio::TypeDesc::UINT16) return convertWhileReading<std::uint16_t>(reader, map, channels);
  return map.keepsAll() ? reader.read<std::uint8_t>() : convertWhileReading<std::uint8_t>(reader, map, channels);
}

Image readPixels(Reader& reader) {
  if (reader.spec().format == oiio::TypeDesc::UINT8) return readNormalized<std::uint8_t>(reader);
  if (reader.spec().format == oiio::TypeDesc::UINT16) return readNormalized<std::uint16_t>(reader);
  return reader.read<float>();
}

ImageShape readShape(const ImageSource& source) {
  return guarded(source.name, [&] { return Reader(source).shape(); });
}

ImageFile read(const ImageSource& source) {
  return guarded(source.name, [&] {
    Reader reader(source);
    reader.requireMemory(sizeof(float), reader.spec().nchannels, source.limits);
    ImageFile result{{}, reader.info()};
    result.pixels = readPixels(reader);
    result.info.images = reader.countImages();
    return result;
  });
}

template <typename T> BasicImage<std::uint32_t> readWidened(Reader& reader) {
  const oiio::ImageSpec spec = reader.spec();
  BasicImage<std::uint32_t> wide;
  wide.width = spec.width, wide.height = spec.height, wide.channels = spec.nchannels;
  wide.pixels.reserve(wide.pixelCount() * static_cast<std::size_t>(spec.nchannels));
  reader.readBands<T>(
      [&](std::span<const T> band) { wide.pixels.insert(wide.pixels.end(), band.begin(), band.end()); });
  return wide;
}

BasicImage<std::uint32_t> readIntegers(const ImageSource& source) {
  return guarded(source.name, [&] {
    Reader reader(source);
    reader.requireMemory(sizeof(std::uint32_t), reader.spec().nchannels, source.limits);
    if (reader.spec().format == oiio::TypeDesc::UINT8) return readWidened<std::uint8_t>(reader);
    if (reader.spec().format == oiio::TypeDesc::UINT16) return readWidened<std::uint16_t>(reader);
    if (reader.spec().format == oiio::TypeDesc::UINT32) return reader.read<std::uint32_t>();
    throw fileError(source.name, "", "holds no unsigned integers");
  });
}

Image8 read8(const ImageSource& source, int channels) {
  return guarded(source.name, [&] {
    Reader reader(source);
    reader.requireMemory(1, channels, source.limits);
    return readAs8(reader, channels);
  });
}

// Into memory: on a full disk the library's own files come out short, and it reports no error (found with HDR).
std::vector<std::byte> encode(const fs::path& file, const Image& image, const WriteOptions& options) {
  const std::string name = file.string();
  if (oiio::Strutil::iends_with(name, ".hdr"))
    for (const float v : image.pixels)
      if (!(v >= 0) || !std::isfinite(v))
        throw fileError(name, "", "the format cannot hold negative or non-finite values; use .exr");
  return guarded(name, [&] {
    const oiio::ImageOutput::unique_ptr output = oiio::ImageOutput::create(name);
    if (!output || !output->supports("ioproxy"))
      throw fileError(name, "cannot be written", output ? "not through memory" : reasonOf(oiio::geterror(), name));
    oiio::ImageSpec spec(image.width, image.height, image.channels,
                         options.half ? oiio::TypeDesc::HALF : oiio::TypeDesc::FLOAT);
    if (std::string_view(output->format_name()) == "openexr") {
      spec.attribute("compression", "zip");
      spec.attribute("DateTime", ""); // without one the library stores the present, and no two files would be equal
      if (!options.channelNames.empty()) {
        spec.channelnames = options.channelNames;
        spec.alpha_channel = -1; // a name, not a position, tells
      }
    }
    std::vector<unsigned char> bytes;
    oiio::Filesystem::IOVecOutput memory(bytes);
    // Closing is where the last bytes come out.
    if (!output->set_ioproxy(&memory) || !output->open(name, spec) ||
        !output->write_image(oiio::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
      throw fileError(name, "cannot be written", reasonOf(output->geterror(), name));
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return std::vector<std::byte>(begin, begin + bytes.size());
  });
}

void limitThreads(int threads) {
  oiio::attribute("threads", threads);
  oiio::attribute("exr_threads", threads);
}

constexpr ImageModule kModule{kImageModuleVersion, limitThreads, readShape, read, readIntegers, read8, encode};

} // namespace

} // namespace parity::base

extern "C" __attribute__((visibility("default"))) const parity::base::ImageModule* parityImageModule() {
  return &parity::base::kModule;
}
