// Image files: checks that need no library, PFM, and the way to the module that holds OpenImageIO.
#include "base/image/image_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/exr_check.h"
#include "base/image/exr_read.h"
#include "base/image/exr_write.h"
#include "base/image/hdr_header.h"
#include "base/image/hdr_read.h"
#include "base/image/hdr_write.h"
#include "base/image/image_format.h"
#include "base/image/image_module.h"
#include "base/image/jpeg_header.h"
#include "base/image/pfm.h"
#include "base/image/png_check.h"
#include "base/image/png_read.h"
#include "base/image/png_write.h"
#include "base/image/tiff_read.h"
#include "base/image/webp.h"
#include "base/module_file.h"
#include "base/parallel.h"

namespace parity::base {

namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleFile = "parity_imageio.so";

std::string extensionOf(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

const ImageModule& loadModule() {
  const auto get = reinterpret_cast<GetImageModule>(
      moduleFunction(kModuleFile, kGetImageModule, "OpenImageIO 2.4 is needed: install libopenimageio2.4",
                     "this image file cannot be read"));
  const ImageModule* module = get();
  if (!module || module->version != kImageModuleVersion)
    throw Error(ExitCode::failed, kModuleFile, "",
                "belongs to another build of this program; build or install both together");
  module->limitThreads(threadCount());
  return *module;
}

const ImageModule& imageModule() {
  static const ImageModule& module = loadModule(); // once, whichever thread comes first; tried again after a failure
  return module;
}

// The first bytes of a file, or all.
std::vector<std::byte> readHead(const fs::path& file) {
  constexpr std::size_t kHeadBytes = std::size_t{1} << 20;
  const std::uintmax_t size = regularFileSize(file);
  if (size == 0) throw fileError(file.string(), "", "is empty");
  std::vector<std::byte> head(static_cast<std::size_t>(std::min<std::uintmax_t>(size, kHeadBytes)));
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return head;
}

ImageFormat requireFormat(std::span<const std::byte> head, const std::string& name, const std::string& extension) {
  if (const std::optional<ImageFormat> format = findImageFormat(head, extension)) return *format;
  throw fileError(name, "cannot be decoded", "is not one of " + std::string(kImageFormats));
}

// A file whose format is known and whose header has been checked as far as the library does not check it.
struct CheckedFile {
  ImageFormat format;
  ImageSource source;
  std::vector<std::byte> png; // the whole file, if it is one
};

CheckedFile checkFile(const fs::path& file, const ImageLimits& limits, bool isRead = true) {
  const std::string name = file.string();
  std::vector<std::byte> head = readHead(file), png;
  const ImageFormat format = requireFormat(head, name, extensionOf(file));
  if (format == ImageFormat::png && isRead) {
    png = head.size() == regularFileSize(file) ? std::move(head) : readFile(file);
    checkPng(png, name, limits);
  }
  if (format == ImageFormat::exr) checkExr(head, regularFileSize(file), name);
  if (format == ImageFormat::jpeg) readJpegShape(readFile(file), name, limits);
  return {format, {.name = name, .format = readerOf(format), .limits = limits}, std::move(png)};
}

ImageFile describePfm(Image pixels) {
  ImageFile result{std::move(pixels), {}};
  result.info.bits = 32;
  result.info.fullWidth = result.pixels.width;
  result.info.fullHeight = result.pixels.height;
  result.info.channelNames =
      result.pixels.channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  return result;
}

void checkChannels(int channels) {
  if (channels < 1 || channels > 4) throw std::invalid_argument("8-bit images have 1 to 4 channels");
}

template <typename T>
void checkWritable(const fs::path& file, const BasicImage<T>& image, const WriteOptions& options) {
  const std::string name = file.string(), extension = extensionOf(file);
  checkImageSize(name, image.width, image.height, image.channels);
  if (image.pixels.size() != image.pixelCount() * static_cast<std::size_t>(image.channels))
    throw fileError(name, "", "the image's size does not fit its pixels");
  struct Format {
    const char* extension;
    int minChannels, maxChannels;
  };
  constexpr std::array kFormats{Format{".png", 1, 4}, Format{".exr", 1, kMaxImageChannels}, Format{".hdr", 3, 3},
                                Format{".pfm", 1, 3}};
  const auto format =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& known) { return extension == known.extension; });
  if (format == kFormats.end())
    throw fileError(name, "", "cannot be written in this format; use .png, .exr, .hdr or .pfm");
  if (image.channels < format->minChannels || image.channels > format->maxChannels)
    throw fileError(name, "", fmt::format("{} cannot hold {} channels", extension, image.channels));
  if (!options.channelNames.empty() && options.channelNames.size() != static_cast<std::size_t>(image.channels))
    throw fileError(name, "",
                    fmt::format("{} channel names for {} channels", options.channelNames.size(), image.channels));
  // Two channels of one name would be one in the file.
  const std::set<std::string> distinct(options.channelNames.begin(), options.channelNames.end());
  if (distinct.size() != options.channelNames.size() || distinct.contains(""))
    throw fileError(name, "", "a channel name is empty or used twice");
}

Image8 roundTo8(const Image& image) {
  Image8 rounded(image.width, image.height, image.channels);
  // Both comparisons are false for NaN, which is written as 0.
  std::transform(image.pixels.begin(), image.pixels.end(), rounded.pixels.begin(), [](float v) {
    return static_cast<std::uint8_t>(v >= 1 ? 255.0f : v > 0 ? v * 255.0f + 0.5f : 0.0f);
  });
  return rounded;
}

} // namespace

Image readImage(const fs::path& file, const ImageLimits& limits) { return readImageFile(file, limits).pixels; }

ImageFile readImageFile(const fs::path& file, const ImageLimits& limits) {
  StoredImage stored = readStoredImage(file, limits);
  if (!stored.bytes.empty()) stored.file.pixels = toFloats(stored.bytes);
  return std::move(stored.file);
}

StoredImage readStoredImage(const fs::path& file, const ImageLimits& limits) {
  const auto [format, source, png] = checkFile(file, limits);
  if (format == ImageFormat::webp) return {readWebp(readFile(file), source.name, limits), {}};
  if (format == ImageFormat::pfm) return {describePfm(readPfm(file, limits)), {}};
  if (format == ImageFormat::png)
    if (const auto samples = readPng(png, PngUse::described, limits.maxBytes, sizeof(float))) {
      if (samples->info.bits == 8) return {{{}, samples->info}, toImage8(*samples)};
      return {{toImage(*samples), samples->info}, {}};
    }
  if (format == ImageFormat::exr)
    if (std::optional<ImageFile> read = readExr(readFile(file), limits)) return {std::move(*read), {}};
  if (format == ImageFormat::hdr)
    if (std::optional<ImageFile> read = readHdr(readFile(file), limits)) return {std::move(*read), {}};
  if (format == ImageFormat::tiff)
    if (std::optional<TiffPicture> read = readTiff(file, limits, sizeof(float))) {
      const ImageInfo info = read->info;
      if (Image8* bytes = std::get_if<Image8>(&read->pixels)) return {{{}, info}, std::move(*bytes)};
      return {{toImage(std::move(*read)), info}, {}};
    }
  return {imageModule().read(source), {}};
}

Image toFloats(const Image8& bytes) {
  // Division, not multiplication with a reciprocal: v/255 is exact where other programs are.
  std::array<float, 256> shares;
  for (std::size_t v = 0; v < shares.size(); ++v) shares[v] = static_cast<float>(v) / 255.0f;
  Image image;
  image.width = bytes.width, image.height = bytes.height, image.channels = bytes.channels;
  image.pixels.resize(bytes.pixels.size());
  std::transform(bytes.pixels.begin(), bytes.pixels.end(), image.pixels.begin(),
                 [&](std::uint8_t v) { return shares[v]; });
  return image;
}

ImageShape readImageShape(const fs::path& file, const ImageLimits& limits) {
  const auto [format, source, png] = checkFile(file, limits, false);
  if (format == ImageFormat::png) return readPngShape(readHead(file), source.name, limits);
  if (format == ImageFormat::jpeg) return readJpegShape(readFile(file), source.name, limits);
  if (format == ImageFormat::pfm) return readPfmShape(readHead(file), source.name, limits);
  if (format == ImageFormat::webp) return readWebpShape(readHead(file), source.name, limits);
  if (format == ImageFormat::exr)
    if (const auto shape = readExrShape(readHead(file), regularFileSize(file), limits)) return *shape;
  if (format == ImageFormat::tiff)
    if (const auto shape = readTiffShape(file, limits)) return *shape;
  return imageModule().readShape(source);
}

BasicImage<std::uint32_t> readIntegers(const fs::path& file, const ImageLimits& limits) {
  const auto [format, source, png] = checkFile(file, limits);
  if (format == ImageFormat::pfm) throw fileError(source.name, "", "holds floats, not integers");
  if (format == ImageFormat::png)
    if (const auto samples = readPng(png, PngUse::samplesOnly, limits.maxBytes, sizeof(std::uint32_t)))
      return toIntegers(*samples);
  if (format == ImageFormat::tiff)
    if (const auto read = readTiff(file, limits, sizeof(std::uint32_t)))
      if (auto integers = toIntegers(*read)) return std::move(*integers);
  if (format != ImageFormat::webp) return imageModule().readIntegers(source);
  const Image8 stored = decodeWebp(readFile(file), source.name, 4, limits);
  BasicImage<std::uint32_t> wide(stored.width, stored.height, stored.channels);
  std::copy(stored.pixels.begin(), stored.pixels.end(), wide.pixels.begin());
  return wide;
}

Image8 readImage8(const fs::path& file, int channels, const ImageLimits& limits) {
  checkChannels(channels);
  const auto [format, source, png] = checkFile(file, limits);
  if (format == ImageFormat::webp) return decodeWebp(readFile(file), source.name, channels, limits);
  if (format == ImageFormat::png)
    if (const auto samples = readPng(png, PngUse::samplesOnly, limits.maxBytes, 1, channels))
      return toImage8(*samples, channels);
  if (format == ImageFormat::tiff)
    if (auto read = readTiff(file, limits, 1, channels))
      if (auto bytes = toImage8(std::move(*read), channels)) return std::move(*bytes);
  return imageModule().read8(source, channels);
}

Image8 decodeImage8(std::span<const std::byte> bytes, const std::string& name, int channels,
                    const ImageLimits& limits) {
  checkChannels(channels);
  if (bytes.empty()) throw fileError(name, "", "is empty");
  const ImageFormat format = requireFormat(bytes, name, "");
  if (format == ImageFormat::webp) return decodeWebp(bytes, name, channels, limits);
  if (format == ImageFormat::jpeg) readJpegShape(bytes, name, limits);
  checkPng(bytes, name, limits);
  if (format == ImageFormat::png)
    if (const auto samples = readPng(bytes, PngUse::samplesOnly, limits.maxBytes, 1, channels))
      return toImage8(*samples, channels);
  checkExr(bytes, bytes.size(), name);
  return imageModule().read8({.name = name, .format = readerOf(format), .bytes = bytes, .limits = limits}, channels);
}

ImageFile decodeRadiance(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  if (bytes.empty()) throw fileError(name, "", "is empty");
  const std::optional<ImageFormat> format = findImageFormat(bytes, "");
  if (format == ImageFormat::pfm) return describePfm(decodePfm(bytes, name, limits));
  if (format != ImageFormat::hdr && format != ImageFormat::exr)
    throw fileError(name, "", "is not an HDR environment; give a .hdr, .exr or .pfm file");
  checkExr(bytes, bytes.size(), name);
  ImageSource source{.name = name, .format = readerOf(*format), .bytes = bytes, .limits = limits};
  source.limits.maxPixels = std::min(limits.maxPixels, kMaxRadiancePixels);
  if (*format == ImageFormat::exr)
    if (std::optional<ImageFile> read = readExr(bytes, source.limits)) return std::move(*read);
  if (*format == ImageFormat::hdr)
    if (std::optional<ImageFile> read = readHdr(bytes, source.limits)) return std::move(*read);
  if (imageModule().readShape(source).integer)
    throw fileError(name, "",
                    "holds integers, so it is not an HDR environment; give a .hdr, .exr or .pfm file of floats");
  ImageFile file = imageModule().read(source);
  if (*format == ImageFormat::hdr) file.info.orientation = readHdrOrientation(bytes, name);
  return file;
}

bool isIntegerImage(const fs::path& file) { return readImageShape(file).integer; }

void writeImage(const fs::path& file, const Image& image, const WriteOptions& options) {
  checkWritable(file, image, options);
  if (extensionOf(file) == ".pfm") return writePfm(file, image);
  if (extensionOf(file) == ".png") return writeBytes(file, encodePng(roundTo8(image), options.pngCompression));
  if (extensionOf(file) == ".exr") return writeBytes(file, encodeExr(image, options, file.string()));
  writeBytes(file, encodeHdr(image, file.string()));
}

void writeImage8(const fs::path& file, const Image8& image, const WriteOptions& options) {
  writeBytes(file, encodeImage8(file, image, options));
}

std::vector<std::byte> encodeImage8(const fs::path& file, const Image8& image, const WriteOptions& options) {
  checkWritable(file, image, options);
  if (extensionOf(file) != ".png") throw fileError(file.string(), "", "8-bit images are written as .png only");
  return encodePng(image, options.pngCompression);
}

fs::path imageModuleFile() {
  std::error_code error;
  for (fs::path& file : moduleCandidates(kModuleFile))
    if (fs::exists(file, error)) return std::move(file);
  return {};
}

} // namespace parity::base
