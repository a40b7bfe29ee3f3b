// Image files. All are written here, and plain PNG, OpenEXR, Radiance HDR and TIFF, WebP and PFM are read here; all
// else is read by OpenImageIO, which is loaded on first use: its 261 shared libraries would cost every start 0.3 s.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "base/image/image_limits.h"

namespace parity::base {

// Reads an image of one of the formats of image_format.h, told by its content. Integer files come as stored / maximum
// (no transfer function is undone, no ICC profile applied), float files as they are; the first image of the file, all
// its channels, R,G,B,A first where they have these names. A damaged or truncated file is an error, never a partial
// image. What the header asks for is checked against the limits before it is taken. Throws Error (exit 4).
Image readImage(const std::filesystem::path& file, const ImageLimits& limits = {});

// What a file says of its pixels beyond their values.
struct ImageInfo {
  bool integer = false; // stored as integers of any width; else half or float
  int bits = 0;         // of one stored value
  std::vector<std::string> channelNames;
  int alphaChannel = -1;        // -1: none
  bool alphaAssociated = false; // the colour has been multiplied by alpha, as OpenEXR demands and PNG forbids
  bool declaredLinear = false;  // the file itself says that its values are linear light
  std::optional<std::array<float, 8>> chromaticities; // x, y of red, green, blue and white, where the file has them
  int x = 0, y = 0;                                   // where the pixels lie (the data window of OpenEXR) ...
  int fullX = 0, fullY = 0, fullWidth = 0, fullHeight = 0; // ... and the picture that they are a part of
  int orientation = 1;    // how the pixels are to be turned to be seen (EXIF: 1, not at all, to 8); reading does not
  bool isCubeMap = false; // six faces, as the envmap attribute of OpenEXR says
  int images = 1;         // in the file, of which the first one is read; kMaxCountedImages stands for more
};
inline constexpr int kMaxCountedImages = 100;

struct ImageFile {
  Image pixels; // as readImage() gives them
  ImageInfo info;
};

// readImage(), and what else the file says. Throws Error (exit 4).
ImageFile readImageFile(const std::filesystem::path& file, const ImageLimits& limits = {});

// readImageFile(), but of PNG and TIFF files of 8-bit integers, where they are plain, `bytes` holds the pixels as
// stored, and file.pixels is empty.
struct StoredImage {
  ImageFile file;
  Image8 bytes;
};
StoredImage readStoredImage(const std::filesystem::path& file, const ImageLimits& limits = {});
// Divided by 255, as readImage() has them.
Image toFloats(const Image8& bytes);

// How large a picture is, by its header.
struct ImageShape {
  int width = 0, height = 0;
  int channels = 0; // of a PNG with a palette the most that there may be
  bool integer = false;
};

// No pixels are read. Throws Error (exit 4), also for a size beyond the limits.
ImageShape readImageShape(const std::filesystem::path& file, const ImageLimits& limits = {});

// The integers that an integer file (8, 16 or 32 bit) stores, all channels, unscaled: ids. Throws Error (exit 4), also
// for a file of floats.
BasicImage<std::uint32_t> readIntegers(const std::filesystem::path& file, const ImageLimits& limits = {});

// Reads an image as 8 bit, converted to exactly `channels` (1..4) channels: grey is spread over RGB, a missing alpha is
// 255; 1 is the first channel, 2 the first and alpha. Alpha is not multiplied into the colour, whatever the format.
// 16-bit files are rounded to 8, floats clamped to [0,1]. Throws Error (exit 4).
Image8 readImage8(const std::filesystem::path& file, int channels = 4, const ImageLimits& limits = {});

// The same from memory (an embedded texture); `name` is for messages. Throws Error (exit 4).
Image8 decodeImage8(std::span<const std::byte> bytes, const std::string& name, int channels = 4,
                    const ImageLimits& limits = {});

// Largest number of pixels of a panorama: 16384 x 8192.
inline constexpr std::size_t kMaxRadiancePixels = std::size_t{1} << 27;

// Radiance from memory: Radiance HDR, OpenEXR of floats, or PFM, told by its first bytes; no other reader is tried. As
// stored; how a Radiance HDR is to be turned, as its header says, stands in info.orientation. Throws Error (exit 4).
ImageFile decodeRadiance(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

// Whether the file, by its format and stored type, holds display-referred 8- or 16-bit integers rather than floats.
bool isIntegerImage(const std::filesystem::path& file);

struct WriteOptions {
  std::vector<std::string> channelNames; // EXR only, distinct; empty: R,G,B,A or Y or Y,A
  bool half = false;                     // EXR only: store 16-bit floats; beyond 65504 they are infinite
  // libdeflate's level, 1 to 12. Of rendered pictures 1 takes 10 to 12 ms a million pixels of RGB; 6 takes twice as
  // long for 6 % fewer bytes. Of plots 6 is smaller by far.
  int pngCompression = 1;
};

// Writes by the extension: .png (8 bit, value*255+0.5, clamped, NaN as 0; the caller has applied the transfer
// function), .exr and .pfm (float; .pfm takes 1 or 3 channels), .hdr (3 channels, neither negative nor non-finite). The
// same image gives the same bytes. Made in memory, written to a temporary name and renamed. Throws Error (exit 4).
void writeImage(const std::filesystem::path& file, const Image& image, const WriteOptions& options = {});

// The same for 8-bit data as it is, to .png.
void writeImage8(const std::filesystem::path& file, const Image8& image, const WriteOptions& options = {});
// The bytes of that file, which is not written; `file` is for messages and must end in .png. Throws Error (exit 4).
std::vector<std::byte> encodeImage8(const std::filesystem::path& file, const Image8& image,
                                    const WriteOptions& options = {});

// The file of the module that holds OpenImageIO, which is loaded on first use; empty where there is none.
std::filesystem::path imageModuleFile();

} // namespace parity::base
