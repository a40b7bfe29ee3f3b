// The module that holds OpenImageIO: reads what image_io.cpp does not read by itself.
#include "base/image/image_module.h"

#include <exception>
#include <limits>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/image/channel_map.h"
#include "base/image/image_reader.h"

namespace parity::base {

namespace {

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

void limitThreads(int threads) {
  oiio::attribute("threads", threads);
  oiio::attribute("exr_threads", threads);
}

constexpr ImageModule kModule{kImageModuleVersion, limitThreads, readShape, read, readIntegers, read8};

} // namespace

} // namespace parity::base

extern "C" __attribute__((visibility("default"))) const parity::base::ImageModule* parityImageModule() {
  return &parity::base::kModule;
}
