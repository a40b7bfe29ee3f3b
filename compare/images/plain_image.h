// Any picture from a file, made comparable: colour in a known space, alpha dealt with, and what was assumed in words.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/image/image.h"
#include "base/image/image_io.h"

namespace parity::compare {

enum class AlphaMode {
  composite, // over a background, in linear light
  channel,   // colour as stored, alpha beside it as a picture of its own
  ignore,    // dropped; colour as stored
};
inline constexpr std::array<std::string_view, 3> kAlphaModeNames = {"composite", "channel", "ignore"};

struct PlainImageOptions {
  // "auto": integers are sRGB unless the file declares them linear; floats are linear, with the primaries that the file
  // declares (Rec.709 where it declares none). "raw": values are shown as they are stored. Or one of
  // base::colorSpaceNames(), for integers and floats alike.
  std::string colorSpace = "auto";
  AlphaMode alpha = AlphaMode::composite;
  std::array<float, 3> background{}; // linear Rec.709 (with "raw": stored values)
  base::ImageLimits limits{};        // of each file; of maxBytes, what comparing the pair takes
  bool ignoreLayers = false;         // what a file holds beyond the colour and alpha of its first image may differ
  bool keepBytes = false;            // PlainImage::bytes may be filled
};

struct PlainImage {
  std::string file;
  base::Image color;      // RGB; display-encoded sRGB where `encoded`, else linear Rec.709; not checked for NaN
  base::Image8 bytes;     // where asked for, RGB of 8 bit that is shown as it is stored; `color` is empty then
  base::Image alpha;      // 1 channel; only with AlphaMode::channel, and where the file has one
  bool encoded = false;   // what `color` holds
  bool integer = false;   // how the file stores it
  int bits = 0;           // of one stored value
  int colorChannels = 0;  // 1 or 3 in the file; grey has been spread
  bool hasAlpha = false;  // in the file
  bool invisible = false; // every pixel was wholly transparent: the background is all that `color` holds
  base::ImageInfo info;   // what else the file says
  base::Image further;    // the channels beyond colour and alpha; as stored, empty: none
  std::vector<std::string> furtherNames; // theirs
  std::string colorSpace;                // "srgb", "linear", ...: what was taken
  std::string colorReason;               // "declared on the command line", "assumed of 8-bit integers"
  std::vector<std::string> notes;        // what was left out or taken for something else

  int width() const { return bytes.empty() ? color.width : bytes.width; }
  int height() const { return bytes.empty() ? color.height : bytes.height; }
};

// Colour that is associated with alpha (OpenEXR, some TIFF) is composited as C + (1-a) B, else as a C + (1-a) B
// (T. Porter and T. Duff 1984, "over"). Opaque pixels keep their stored values exactly. A pixel whose alpha is NaN or
// infinite gets a NaN colour when composited. Throws Error: failed (exit 4) for a file that cannot be read or declares
// primaries of no known colour space; notComparable for channels that are neither grey nor RGB; usage for an unknown
// colour space.
PlainImage readPlainImage(const std::filesystem::path& file, const PlainImageOptions& options);

// Moves PlainImage::bytes, where there are any, into `color`.
void spreadBytes(PlainImage& image);

// Display-encoded sRGB in [0,1] / linear Rec.709 of a picture; a copy where it is that already.
base::Image toDisplay(const PlainImage& image);
base::Image toLinear(const PlainImage& image);

// "grey", "RGB + alpha", ...: the channels in words.
std::string describeChannels(const PlainImage& image);

// Throws Error (notComparable), naming the test's file, where these differ: sizes; the place of the pixels in the whole
// picture (the windows of OpenEXR) and their orientation; channels: grey against RGB, and alpha in one file alone
// unless it is ignored; unless layers are ignored, the names and bits of further channels, and how many images the
// files hold.
void requireComparable(const PlainImage& reference, const PlainImage& test, const PlainImageOptions& options);

// Whether the files hold something that is not compared: further images, layers that are ignored.
bool isPartial(const PlainImage& image, const PlainImageOptions& options);

} // namespace parity::compare
