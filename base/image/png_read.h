// PNG without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/image/image_io.h"

namespace parity::base {

// The samples of a PNG file as they are stored, but for palettes, which are looked up, and for grey of less than 8
// bits, which is scaled to 8; a colour that is transparent (tRNS) has become alpha.
struct PngSamples {
  ImageInfo info;
  int width = 0, height = 0, channels = 0;
  std::unique_ptr<std::uint8_t[]> bytes; // 16 bit: big-endian
  std::size_t first = 0, rowBytes = 0;   // where the first row begins, and what the next one is apart

  const std::uint8_t* row(int y) const { return bytes.get() + first + rowBytes * static_cast<std::size_t>(y); }
};

enum class PngUse { described, samplesOnly }; // info is complete or not

// Reads a file that checkPng() (png_check.h) has let pass. Nothing where the image library has to read it or to say
// what is wrong: damage, more than maxBytes, a description that only the library reads (EXIF, XMP). What is returned is
// what the library would read. valueBytes, channels: what the caller makes of each value, and how many channels (0:
// all), to be counted against maxBytes.
std::optional<PngSamples> readPng(std::span<const std::byte> bytes, PngUse use, std::size_t maxBytes,
                                  std::size_t valueBytes, int channels = 0);

Image toImage(const PngSamples& samples);                        // stored / maximum
Image8 toImage8(const PngSamples& samples, int channels);        // as readImage8() says
Image8 toImage8(const PngSamples& samples);                      // of 8 bit: as stored
BasicImage<std::uint32_t> toIntegers(const PngSamples& samples); // as stored

} // namespace parity::base
