// A TIFF file by libtiff: what its first picture is, and how it lies in the file.
#pragma once

#include <filesystem>
#include <optional>

#include <tiffio.h>

#include "base/image/image_io.h"

namespace parity::base {

// One open file. No message of libtiff is shown. A thread needs its own.
class TiffFile {
public:
  explicit TiffFile(const std::filesystem::path& file);
  ~TiffFile();
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;

  TIFF* get() const { return m_tiff; } // null: libtiff cannot open it
  // Whether libtiff has had something to say since the last call.
  bool takeMessage();

private:
  bool m_hasMessage = false;
  TIFF* m_tiff = nullptr;
};

// The parts that are packed each for itself: strips are as wide as the picture. Where the planes are apart, each plane
// has as many parts.
struct TiffLayout {
  ImageInfo info;
  int width = 0, height = 0, channels = 0, sampleBytes = 0;
  bool isTiled = false, isSeparate = false;
  int compression = 0;
  int partWidth = 0, partHeight = 0, across = 0, down = 0;

  int planes() const { return isSeparate ? channels : 1; }
  int partChannels() const { return isSeparate ? 1 : channels; }
};

// Nothing where the image library has to read the file: more than one picture, or anything beyond grey or RGB, with or
// without alpha, of 8 or 16 bit integers or 32 bit floats; more than the limits of pixels.
std::optional<TiffLayout> readTiffLayout(TIFF* tiff, const ImageLimits& limits);

} // namespace parity::base
