#include "compare/images/plain_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/image/color.h"
#include "base/image/image_io.h"

namespace parity::compare {

namespace {

// x, y of red, green, blue and white, as in the chromaticities attribute of OpenEXR.
struct Primaries {
  const char* colorSpace;
  std::array<float, 8> xy;
};
constexpr Primaries kPrimaries[] = {
    {"linear", {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f}},             // ITU-R BT.709
    {"acescg", {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f}},     // SMPTE S-2014-004
    {"aces2065-1", {0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.32168f, 0.33767f}}, // SMPTE ST 2065-1
};

const char* spaceOfPrimaries(const std::array<float, 8>& xy) {
  constexpr float kTolerance = 2e-3f; // writers round to three digits
  for (const Primaries& known : kPrimaries)
    if (std::equal(xy.begin(), xy.end(), known.xy.begin(),
                   [](float a, float b) { return std::abs(a - b) <= kTolerance; }))
      return known.colorSpace;
  return nullptr;
}

void chooseColorSpace(PlainImage& image, const base::ImageInfo& info, const std::string& wanted) {
  if (wanted != "auto") {
    image.colorSpace = wanted;
    image.colorReason = "declared on the command line";
  } else if (info.integer) {
    image.colorSpace = info.declaredLinear ? "linear" : "srgb";
    image.colorReason =
        info.declaredLinear ? "declared by the file" : fmt::format("assumed of {}-bit integers", info.bits);
  } else if (info.chromaticities) {
    const char* space = spaceOfPrimaries(*info.chromaticities);
    if (!space)
      throw base::fileError(image.file, "chromaticities",
                            fmt::format("{:.4g} are the primaries of an unknown colour space; set --colorspace",
                                        fmt::join(*info.chromaticities, " ")));
    image.colorSpace = space;
    image.colorReason = "declared by the file";
  } else {
    image.colorSpace = "linear";
    image.colorReason = "assumed of floats";
  }
}

// Which channels hold colour, and which alpha (-1: none).
struct Layout {
  std::array<int, 3> color{};
  int alpha = -1;
  std::vector<int> further;
};

Layout findChannels(PlainImage& image, const base::ImageInfo& info, int channels) {
  Layout layout;
  layout.alpha = info.alphaChannel;
  std::vector<int> colors;
  for (int c = 0; c < channels; ++c)
    if (c != layout.alpha) colors.push_back(c);
  if (colors.empty() || colors.size() == 2)
    throw base::Error(base::ExitCode::notComparable, image.file, fmt::format("{}", fmt::join(info.channelNames, ", ")),
                      "the channels are not grey or RGB");
  image.colorChannels = colors.size() == 1 ? 1 : 3;
  image.hasAlpha = layout.alpha >= 0;
  for (int c = 0; c < 3; ++c) layout.color[c] = colors[image.colorChannels == 3 ? c : 0];
  const auto nameOf = [&](int c) { return info.channelNames[static_cast<std::size_t>(c)]; };
  if (image.colorChannels == 3 && std::array{nameOf(layout.color[0]), nameOf(layout.color[1]),
                                             nameOf(layout.color[2])} != std::array<std::string, 3>{"R", "G", "B"})
    image.notes.push_back(fmt::format("the channels {}, {}, {} are read as R, G, B", nameOf(layout.color[0]),
                                      nameOf(layout.color[1]), nameOf(layout.color[2])));
  if (colors.size() > 3) layout.further.assign(colors.begin() + 3, colors.end());
  for (const int c : layout.further) image.furtherNames.push_back(nameOf(c));
  return layout;
}

base::Image pickChannels(const base::Image& image, const std::vector<int>& channels) {
  base::Image picked(image.width, image.height, static_cast<int>(channels.size()));
  float* out = picked.pixels.data();
  for (std::size_t p = 0; p < image.pixelCount(); ++p)
    for (const int c : channels) *out++ = image.pixels[p * image.channels + c];
  return picked;
}

// Porter and Duff's "over" with a background that covers all.
base::Image compositeOver(const base::Image& color, const base::Image& alpha, bool associated,
                          const std::array<float, 3>& background) {
  base::Image out = color;
  for (std::size_t p = 0; p < alpha.pixels.size(); ++p) {
    const float a = alpha.pixels[p];
    if (a == 1) continue;
    for (int c = 0; c < 3; ++c) {
      const float own = associated ? color.pixels[3 * p + c] : a * color.pixels[3 * p + c];
      out.pixels[3 * p + c] =
          std::isfinite(a) ? own + (1 - a) * background[c] : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return out;
}

// Encoded colour that has been multiplied by alpha (TIFF) becomes what an opaque pixel would hold.
void dissociate(base::Image& color, const base::Image& alpha) {
  for (std::size_t p = 0; p < alpha.pixels.size(); ++p)
    if (const float a = alpha.pixels[p]; a > 0)
      for (int c = 0; c < 3; ++c) color.pixels[3 * p + c] /= a;
}

void composite(PlainImage& image, const base::Image& alpha, bool associated, const std::array<float, 3>& background) {
  const auto isZero = [](float v) { return v == 0; };
  image.invisible = std::all_of(alpha.pixels.begin(), alpha.pixels.end(), isZero) &&
                    (!associated || std::all_of(image.color.pixels.begin(), image.color.pixels.end(), isZero));
  if (image.invisible) image.notes.emplace_back("every pixel is transparent, so only the background is visible");
  if (std::all_of(alpha.pixels.begin(), alpha.pixels.end(), [](float a) { return a == 1; })) return;
  if (!image.encoded || image.colorSpace == "raw") {
    image.color = compositeOver(image.color, alpha, associated, background);
    return;
  }
  base::Image stored = image.color;
  if (associated) dissociate(stored, alpha);
  const base::Image linear = compositeOver(base::toLinearRec709(stored, "srgb"), alpha, false, background);
  const base::Image shown = base::DisplayTransform("sRGB").apply(linear);
  for (std::size_t p = 0; p < alpha.pixels.size(); ++p)
    if (alpha.pixels[p] != 1) std::copy_n(shown.pixels.data() + 3 * p, 3, image.color.pixels.data() + 3 * p);
}

std::string describeWindows(const PlainImage& image) {
  const base::ImageInfo& info = image.info;
  return fmt::format("{}x{} at {:+}{:+} of a picture of {}x{} at {:+}{:+}", image.width(), image.height(), info.x,
                     info.y, info.fullWidth, info.fullHeight, info.fullX, info.fullY);
}

bool windowsDiffer(const base::ImageInfo& a, const base::ImageInfo& b) {
  return a.x != b.x || a.y != b.y || a.fullX != b.fullX || a.fullY != b.fullY || a.fullWidth != b.fullWidth ||
         a.fullHeight != b.fullHeight;
}

std::string listChannels(const PlainImage& image) {
  return image.furtherNames.empty() ? "none" : fmt::format("{}", fmt::join(image.furtherNames, ", "));
}

// The names of the further channels whose bits differ; both have the same ones.
std::vector<std::string> differingChannels(const PlainImage& reference, const PlainImage& test) {
  const std::size_t channels = test.furtherNames.size();
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t i = c; i < test.further.pixels.size(); i += channels)
      if (std::bit_cast<std::uint32_t>(reference.further.pixels[i]) !=
          std::bit_cast<std::uint32_t>(test.further.pixels[i])) {
        names.push_back(test.furtherNames[c]);
        break;
      }
  return names;
}

std::string countImages(const PlainImage& image) {
  const int images = image.info.images;
  return fmt::format("{}{} image{}", images, images == base::kMaxCountedImages ? " or more" : "",
                     images == 1 ? "" : "s");
}

void requireSameLayers(const PlainImage& reference, const PlainImage& test) {
  const auto refuse = [&](const std::string& what, const std::string& reason) {
    throw base::Error(base::ExitCode::notComparable, test.file, what,
                      reason + " (--ignore-layers compares only the colour of the first image)");
  };
  if (reference.info.images != test.info.images)
    refuse("holds " + countImages(test), "the reference " + countImages(reference));
  if (reference.furtherNames != test.furtherNames)
    refuse("further channels " + listChannels(test), "the reference has " + listChannels(reference));
  if (const auto differing = differingChannels(reference, test); !differing.empty())
    refuse(fmt::format("{}", fmt::join(differing, ", ")), "differs from the reference, but no metric measures it");
}

} // namespace

PlainImage readPlainImage(const std::filesystem::path& file, const PlainImageOptions& options) {
  base::StoredImage read = base::readStoredImage(file, options.limits);
  base::ImageFile& stored = read.file;
  const int channels = read.bytes.empty() ? stored.pixels.channels : read.bytes.channels;
  PlainImage image;
  image.file = file.string();
  image.integer = stored.info.integer;
  image.bits = stored.info.bits;
  image.info = stored.info;
  chooseColorSpace(image, stored.info, options.colorSpace);
  const Layout layout = findChannels(image, stored.info, channels);
  const bool isPlainRgb = channels == 3 && image.colorChannels == 3;
  const bool isShown = image.colorSpace == "srgb" || image.colorSpace == "raw";
  if (options.keepBytes && isPlainRgb && isShown)
    image.bytes = std::move(read.bytes);
  else if (!read.bytes.empty())
    stored.pixels = base::toFloats(read.bytes), read.bytes = {};
  if (!layout.further.empty()) image.further = pickChannels(stored.pixels, layout.further);
  if (!image.furtherNames.empty())
    image.notes.push_back(fmt::format("the channels {} {}", listChannels(image),
                                      options.ignoreLayers ? "are not compared" : "hold the same bits in both"));
  if (image.info.images > 1)
    image.notes.push_back(fmt::format("holds {}; only the first is compared", countImages(image)));
  if (image.info.orientation != 1)
    image.notes.push_back(
        fmt::format("is compared as stored; its orientation ({}) is not applied", image.info.orientation));
  image.encoded = isShown;
  if (!image.bytes.empty()) return image;
  // The common case is not copied: a picture of 4K is 100 MB.
  image.color =
      isPlainRgb ? std::move(stored.pixels) : pickChannels(stored.pixels, {layout.color.begin(), layout.color.end()});
  if (!image.encoded && image.colorSpace != "linear") image.color = base::toLinearRec709(image.color, image.colorSpace);
  if (!image.hasAlpha || options.alpha == AlphaMode::ignore) return image;
  base::Image alpha = pickChannels(stored.pixels, {layout.alpha});
  if (options.alpha == AlphaMode::channel)
    image.alpha = std::move(alpha);
  else
    composite(image, alpha, stored.info.alphaAssociated, options.background);
  return image;
}

void spreadBytes(PlainImage& image) {
  if (image.bytes.empty()) return;
  image.color = base::toFloats(image.bytes);
  image.bytes = {};
}

base::Image toDisplay(const PlainImage& image) {
  return base::DisplayTransform(image.encoded ? "raw" : "sRGB").apply(image.color);
}

base::Image toLinear(const PlainImage& image) {
  return image.encoded ? base::toLinearRec709(image.color, "srgb") : image.color;
}

std::string describeChannels(const PlainImage& image) {
  return fmt::format("{}{}", image.colorChannels == 1 ? "grey" : "RGB", image.hasAlpha ? " + alpha" : "");
}

bool isPartial(const PlainImage& image, const PlainImageOptions& options) {
  return image.info.images > 1 || (options.ignoreLayers && !image.furtherNames.empty());
}

void requireComparable(const PlainImage& reference, const PlainImage& test, const PlainImageOptions& options) {
  const auto refuse = [&](const std::string& what, const std::string& reason) {
    throw base::Error(base::ExitCode::notComparable, test.file, what, reason);
  };
  if (reference.width() != test.width() || reference.height() != test.height())
    refuse(fmt::format("{}x{}", test.width(), test.height()),
           fmt::format("the reference is {}x{}", reference.width(), reference.height()));
  if (windowsDiffer(reference.info, test.info))
    refuse(describeWindows(test), "the reference is " + describeWindows(reference));
  if (reference.info.orientation != test.info.orientation)
    refuse(fmt::format("orientation {}", test.info.orientation),
           fmt::format("the reference has orientation {}", reference.info.orientation));
  const bool alphaDiffers = reference.hasAlpha != test.hasAlpha && options.alpha != AlphaMode::ignore;
  if (reference.colorChannels != test.colorChannels || alphaDiffers)
    refuse(describeChannels(test), fmt::format("the reference is {}{}", describeChannels(reference),
                                               alphaDiffers ? " (--alpha ignore compares only colour)" : ""));
  if (!options.ignoreLayers) requireSameLayers(reference, test);
}

} // namespace parity::compare
