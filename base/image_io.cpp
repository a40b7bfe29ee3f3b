// Image files: checks that need no library, PFM, and the way to the module that holds OpenImageIO.
#include "base/image_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "base/error.h"
#include "base/exr_check.h"
#include "base/file.h"
#include "base/image_module.h"
#include "base/module_file.h"
#include "base/parallel.h"
#include "base/pfm.h"
#include "base/png_check.h"
#include "base/webp.h"

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
                     "image files cannot be read or written"));
  const ImageModule* module = get();
  if (!module || module->version != kImageModuleVersion)
    throw Error(ExitCode::failed, kModuleFile, "", "belongs to another build of this program: build or install both");
  module->limitThreads(threadCount());
  return *module;
}

const ImageModule& imageModule() {
  static const ImageModule& module = loadModule(); // once, whichever thread comes first; tried again after a failure
  return module;
}

void checkReadable(const fs::path& file) {
  if (regularFileSize(file) == 0) throw fileError(file.string(), "", "is empty");
}

void checkContent(const fs::path& file) {
  checkReadable(file);
  if (extensionOf(file) == ".png") checkPng(readFile(file), file.string());
  if (extensionOf(file) == ".exr") {
    std::vector<char> head(std::min<std::size_t>(regularFileSize(file), std::size_t{1} << 20));
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    checkExr(std::as_bytes(std::span(head)), regularFileSize(file), file.string());
  }
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
    throw fileError(name, "", "a channel name is empty or stands twice");
}

} // namespace

Image readImage(const fs::path& file) { return readImageFile(file).pixels; }

ImageFile readImageFile(const fs::path& file) {
  checkContent(file);
  if (extensionOf(file) != ".pfm") return imageModule().read(file);
  ImageFile result{readPfm(file), {}};
  result.info.bits = 32;
  result.info.fullWidth = result.pixels.width;
  result.info.fullHeight = result.pixels.height;
  result.info.channelNames =
      result.pixels.channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  return result;
}

BasicImage<std::uint32_t> readIntegers(const fs::path& file) {
  checkContent(file);
  if (extensionOf(file) == ".pfm") throw fileError(file.string(), "", "holds floats, not integers");
  return imageModule().readIntegers(file);
}

Image8 readImage8(const fs::path& file, int channels) {
  checkChannels(channels);
  checkContent(file);
  if (extensionOf(file) == ".webp") return decodeWebp(readFile(file), file.string(), channels);
  return imageModule().read8(file, channels);
}

Image8 decodeImage8(std::span<const std::byte> bytes, const std::string& name, int channels) {
  checkChannels(channels);
  if (bytes.empty()) throw fileError(name, "", "is empty");
  checkPng(bytes, name);
  if (isWebp(bytes)) return decodeWebp(bytes, name, channels);
  return imageModule().decode8(bytes, name, channels);
}

Image decodeRadiance(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) throw fileError(name, "", "is empty");
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 2));
  if (head == "PF" || head == "Pf") return decodePfm(bytes, name);
  checkExr(bytes, bytes.size(), name);
  return imageModule().decodeRadiance(bytes, name);
}

bool isIntegerImage(const fs::path& file) {
  checkReadable(file);
  return extensionOf(file) != ".pfm" && imageModule().isInteger(file);
}

void writeImage(const fs::path& file, const Image& image, const WriteOptions& options) {
  checkWritable(file, image, options);
  if (extensionOf(file) == ".pfm") return writePfm(file, image);
  writeBytes(file, imageModule().encode(file, image, options));
}

void writeImage8(const fs::path& file, const Image8& image, const WriteOptions& options) {
  writeBytes(file, encodeImage8(file, image, options));
}

std::vector<std::byte> encodeImage8(const fs::path& file, const Image8& image, const WriteOptions& options) {
  checkWritable(file, image, options);
  if (extensionOf(file) != ".png") throw fileError(file.string(), "", "8-bit images are written as .png only");
  return imageModule().encode8(file, image, options);
}

fs::path imageModuleFile() {
  std::error_code error;
  for (fs::path& file : moduleCandidates(kModuleFile))
    if (fs::exists(file, error)) return std::move(file);
  return {};
}

} // namespace parity::base
