// Image files by OpenImageIO, which is loaded on first use: its 261 shared libraries would cost every start 0.3 s.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"

namespace parity::base {

// Reads any image that OpenImageIO knows, and .pfm. Integer files come as stored / maximum (no transfer function is
// undone), float files as they are; all channels, in file order. Throws Error (exit 4).
Image readImage(const std::filesystem::path& file);

// Reads an image as 8 bit, converted to exactly `channels` channels: grey is spread over RGB, a missing alpha is 255.
// 16-bit files are rounded to 8. Throws Error (exit 4).
Image8 readImage8(const std::filesystem::path& file, int channels = 4);

// The same from memory (an embedded texture); `name` is for messages. Throws Error (exit 4).
Image8 decodeImage8(std::span<const std::byte> bytes, const std::string& name, int channels = 4);

// Whether the file, by its format and stored type, holds display-referred 8- or 16-bit integers rather than floats.
bool isIntegerImage(const std::filesystem::path& file);

struct WriteOptions {
  std::vector<std::string> channelNames; // empty: R,G,B,A or Y
  bool half = false;                     // EXR only: store 16-bit floats
  int pngCompression = 3;                // zlib level: 3 is 4x faster than the default 6 and 5 % larger
};

// Writes by the extension: .png (8 bit, value*255+0.5, clamped; the caller has applied the transfer function), .exr and
// .pfm (float; .pfm takes 1 or 3 channels), .hdr. Written to a temporary name and renamed. Throws Error (exit 4).
void writeImage(const std::filesystem::path& file, const Image& image, const WriteOptions& options = {});

// The same for 8-bit data as it is.
void writeImage8(const std::filesystem::path& file, const Image8& image, const WriteOptions& options = {});

} // namespace parity::base
