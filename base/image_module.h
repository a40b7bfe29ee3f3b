// The border between the program and the module that holds OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/image_io.h"

namespace parity::base {

inline constexpr int kImageModuleVersion = 4; // counts the changes of the struct below
inline constexpr int kMaxImageChannels = 1024;

// What the module offers. Every function throws Error. Files have been checked to be regular and not empty; images and
// options to fit the format.
struct ImageModule {
  int version;
  void (*limitThreads)(int threads); // of the library's own pool
  ImageFile (*read)(const std::filesystem::path& file);
  BasicImage<std::uint32_t> (*readIntegers)(const std::filesystem::path& file);
  Image8 (*read8)(const std::filesystem::path& file, int channels);
  Image8 (*decode8)(std::span<const std::byte> bytes, const std::string& name, int channels);
  Image (*decodeRadiance)(std::span<const std::byte> bytes, const std::string& name);
  bool (*isInteger)(const std::filesystem::path& file);
  // `file` tells the format, and is the name for messages; nothing is written to it.
  std::vector<std::byte> (*encode)(const std::filesystem::path& file, const Image& image, const WriteOptions& options);
  std::vector<std::byte> (*encode8)(const std::filesystem::path& file, const Image8& image,
                                    const WriteOptions& options);
};

// The module exports `const ImageModule* parityImageModule()` with C linkage.
using GetImageModule = const ImageModule* (*)();
inline constexpr const char* kGetImageModule = "parityImageModule";

} // namespace parity::base
