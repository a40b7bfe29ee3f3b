// The border between the program and the module that holds OpenImageIO.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image/image.h"
#include "base/image/image_io.h"
#include "base/image/image_limits.h"

namespace parity::base {

inline constexpr int kImageModuleVersion = 7; // counts the changes of the structs below
inline constexpr int kMaxImageChannels = 1024;

// One image to be read.
struct ImageSource {
  std::string name;                   // of the file, which lies there unless there are bytes
  const char* format = "";            // as the library calls its reader; no other one is tried
  std::span<const std::byte> bytes{}; // not empty: the whole file
  ImageLimits limits{};
};

// What the module offers. Every function throws Error. Files have been checked to be regular and not empty.
struct ImageModule {
  int version;
  void (*limitThreads)(int threads); // of the library's own pool
  ImageShape (*readShape)(const ImageSource& source);
  ImageFile (*read)(const ImageSource& source);
  BasicImage<std::uint32_t> (*readIntegers)(const ImageSource& source);
  Image8 (*read8)(const ImageSource& source, int channels);
};

// The module exports `const ImageModule* parityImageModule()` with C linkage.
using GetImageModule = const ImageModule* (*)();
inline constexpr const char* kGetImageModule = "parityImageModule";

} // namespace parity::base
