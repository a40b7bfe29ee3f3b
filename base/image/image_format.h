// Which of the formats that are read a file has.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace parity::base {

enum class ImageFormat { png, jpeg, tiff, webp, hdr, exr, pfm, bmp, targa, pnm };

// For messages: the formats that are read.
inline constexpr std::string_view kImageFormats = "PNG, JPEG, TIFF, WebP, Radiance HDR, OpenEXR, PFM, BMP, TGA, PNM";

// By the first bytes; TGA, which has no mark, by the header's fields where `extension` is one of its own (".tga", in
// any case). Other formats are none that their readers could be trusted with: several of them take memory, or read
// outside of their buffers, before the size of the picture is known.
std::optional<ImageFormat> findImageFormat(std::span<const std::byte> head, std::string_view extension);

// As the image library calls the reader of the format.
const char* readerOf(ImageFormat format);

} // namespace parity::base
