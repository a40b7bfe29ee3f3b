// The border between the program and the module that holds OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "base/image.h"
#include "base/image_io.h"

namespace parity::base {

// What the module offers. Every function throws Error.
struct ImageModule {
  Image (*read)(const std::filesystem::path& file);
  Image8 (*read8)(const std::filesystem::path& file, int channels);
  Image8 (*decode8)(std::span<const std::byte> bytes, const std::string& name, int channels);
  bool (*isInteger)(const std::filesystem::path& file);
  // `file` is the final name, for messages and for the format; the bytes go to `temporary`.
  void (*write)(const std::filesystem::path& temporary, const std::filesystem::path& file, const Image& image,
                const WriteOptions& options);
  void (*write8)(const std::filesystem::path& temporary, const std::filesystem::path& file, const Image8& image,
                 const WriteOptions& options);
};

// The module exports `const ImageModule* parityImageModule()` with C linkage.
using GetImageModule = const ImageModule* (*)();
inline constexpr const char* kGetImageModule = "parityImageModule";

} // namespace parity::base
