// Size and wholeness of an image file by its header, before memory is taken.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::scenes {

enum class ImageFormat { unknown, png, jpeg, webp, ktx2 };

struct ImageHeader {
  ImageFormat format = ImageFormat::unknown;
  std::size_t width = 0, height = 0; // 0: cut off before it is said
  bool isCutOff = false;             // the file ends before the image does (JPEG, WebP; the PNG decoder says it itself)
};

// PNG (ISO/IEC 15948), JPEG (ITU-T T.81), WebP (RFC 9649) and KTX 2 (Khronos), told apart by their first bytes.
ImageHeader readImageHeader(std::span<const std::byte> bytes);

} // namespace parity::scenes
