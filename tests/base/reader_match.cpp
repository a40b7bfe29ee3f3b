// Both readers of one file.
#include "reader_match.h"

#include <cstring>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/exr_check.h"
#include "base/image/exr_read.h"
#include "base/image/hdr_read.h"
#include "base/image/image_module.h"
#include "base/image/png_check.h"
#include "base/image/png_read.h"
#include "base/image/tiff_read.h"
#include "base/module_file.h"
#include "temp_folder.h"

namespace parity::base {

namespace {

const ImageModule& library() {
  static const auto get =
      reinterpret_cast<GetImageModule>(moduleFunction("parity_imageio.so", kGetImageModule, "", ""));
  return *get();
}

template <typename T> void expectSame(const BasicImage<T>& ours, const BasicImage<T>& theirs, const std::string& what) {
  ASSERT_EQ(ours.width, theirs.width) << what;
  ASSERT_EQ(ours.height, theirs.height) << what;
  ASSERT_EQ(ours.channels, theirs.channels) << what;
  ASSERT_EQ(ours.pixels.size(), theirs.pixels.size()) << what;
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) // bit for bit: NaN, too
    ASSERT_EQ(std::memcmp(&ours.pixels[i], &theirs.pixels[i], sizeof(T)), 0)
        << what << ", value " << i << ": " << +ours.pixels[i] << " against " << +theirs.pixels[i];
}

void expectSame(const ImageInfo& ours, const ImageInfo& theirs) {
  EXPECT_EQ(ours.integer, theirs.integer);
  EXPECT_EQ(ours.bits, theirs.bits);
  EXPECT_EQ(ours.channelNames, theirs.channelNames);
  EXPECT_EQ(ours.alphaChannel, theirs.alphaChannel);
  EXPECT_EQ(ours.alphaAssociated, theirs.alphaAssociated);
  EXPECT_EQ(ours.declaredLinear, theirs.declaredLinear);
  EXPECT_EQ(ours.chromaticities, theirs.chromaticities);
  EXPECT_EQ(ours.x, theirs.x);
  EXPECT_EQ(ours.y, theirs.y);
  EXPECT_EQ(ours.fullX, theirs.fullX);
  EXPECT_EQ(ours.fullY, theirs.fullY);
  EXPECT_EQ(ours.fullWidth, theirs.fullWidth);
  EXPECT_EQ(ours.fullHeight, theirs.fullHeight);
  EXPECT_EQ(ours.orientation, theirs.orientation);
  EXPECT_EQ(ours.isCubeMap, theirs.isCubeMap);
  EXPECT_EQ(ours.images, theirs.images);
}

// What checks every file before a reader sees it.
bool isChecked(std::span<const std::byte> bytes, const std::string& name) {
  try {
    checkPng(bytes, name);
    checkExr(bytes, bytes.size(), name);
    return true;
  } catch (const Error&) {
    return false;
  }
}

} // namespace

bool expectAsLibrary(const std::filesystem::path& file, std::span<const std::byte> bytes, OwnReader own) {
  if (own == OwnReader::mayRefuse && !isChecked(bytes, file.string())) return false;
  const bool isPng = bytes.size() > 1 && bytes[1] == std::byte{'P'},
             isHdr = bytes.size() > 1 && bytes[0] == std::byte{'#'};
  const std::size_t noLimit = ImageLimits{}.maxBytes;
  std::optional<ImageFile> ours;
  std::optional<PngSamples> samples;
  std::optional<ImageShape> shape;
  if (isPng) {
    samples = readPng(bytes, PngUse::samplesOnly, noLimit, 4);
    if (const auto described = readPng(bytes, PngUse::described, noLimit, 4))
      ours = ImageFile{toImage(*described), described->info};
  } else if (isHdr) {
    ours = readHdr(bytes, {});
  } else {
    ours = readExr(bytes, {});
    shape = readExrShape(bytes, bytes.size(), {});
  }
  if (own == OwnReader::reads) {
    EXPECT_TRUE(ours.has_value());
  }
  if (!ours && !samples && !shape) return false;
  const ImageSource source{.name = file.string(), .format = isPng ? "png" : isHdr ? "hdr" : "openexr", .bytes = bytes};
  try {
    if (shape) {
      const ImageShape theirs = library().readShape(source);
      EXPECT_EQ(std::tie(shape->width, shape->height, shape->channels, shape->integer),
                std::tie(theirs.width, theirs.height, theirs.channels, theirs.integer));
    }
    if (!ours && !samples) return false;
    const ImageFile theirs = library().read(source);
    if (ours) expectSame(ours->info, theirs.info);
    if (ours) expectSame(ours->pixels, theirs.pixels, "readImageFile()");
    if (samples) {
      expectSame(toImage(*samples), theirs.pixels, "samples alone");
      expectSame(toIntegers(*samples), library().readIntegers(source), "readIntegers()");
      for (int channels = 1; channels <= 4; ++channels)
        expectSame(toImage8(*samples, channels), library().read8(source, channels), "readImage8()");
    }
  } catch (const Error& error) {
    ADD_FAILURE() << "read by us, but not by the library: " << error.what();
  }
  return ours.has_value();
}

bool expectTiffAsLibrary(std::span<const std::byte> bytes, OwnReader own) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "a.tif";
  writeBytes(file, bytes);
  const std::optional<TiffPicture> ours = readTiff(file, {}, sizeof(float));
  const std::optional<ImageShape> shape = readTiffShape(file, {});
  if (own == OwnReader::reads) {
    EXPECT_TRUE(ours.has_value());
  }
  if (!ours && !shape) return false;
  const std::string name = file.string();
  const ImageSource source{.name = name, .format = "tiff"};
  try {
    if (shape) {
      const ImageShape theirs = library().readShape(source);
      EXPECT_EQ(std::tie(shape->width, shape->height, shape->channels, shape->integer),
                std::tie(theirs.width, theirs.height, theirs.channels, theirs.integer));
    }
    if (!ours) return false;
    const ImageFile theirs = library().read(source);
    expectSame(ours->info, theirs.info);
    expectSame(toImage(TiffPicture(*ours)), theirs.pixels, "readImageFile()");
    EXPECT_EQ(toIntegers(*ours).has_value(), ours->info.integer);
    if (const auto integers = toIntegers(*ours))
      expectSame(*integers, library().readIntegers(source), "readIntegers()");
    for (int channels = 1; channels <= 4; ++channels)
      if (const auto bytes8 = toImage8(TiffPicture(*ours), channels))
        expectSame(*bytes8, library().read8(source, channels), "readImage8()");
  } catch (const Error& error) {
    ADD_FAILURE() << "read by us, but not by the library: " << error.what();
  }
  return ours.has_value();
}

} // namespace parity::base
