// TIFF without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>

#include "base/image/image_io.h"

namespace parity::base {

// As stored.
struct TiffPicture {
  ImageInfo info;
  std::variant<Image8, BasicImage<std::uint16_t>, Image> pixels;
};

// Nothing where the image library has to read it or to say what is wrong: damage, more than the limits, whatever is not
// plain (tiff_file.h). What is returned is what the library would read. valueBytes, channels: what the caller makes of
// each value, and how many channels (0: all), to be counted against limits.maxBytes.
std::optional<TiffPicture> readTiff(const std::filesystem::path& file, const ImageLimits& limits,
                                    std::size_t valueBytes, int channels = 0);
std::optional<ImageShape> readTiffShape(const std::filesystem::path& file, const ImageLimits& limits);

Image toImage(TiffPicture&& picture);                                            // stored / maximum; floats as they are
std::optional<Image8> toImage8(TiffPicture&& picture, int channels);             // as readImage8() says; not of floats
std::optional<BasicImage<std::uint32_t>> toIntegers(const TiffPicture& picture); // as stored; not of floats

} // namespace parity::base
