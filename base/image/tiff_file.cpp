#include "base/image/tiff_file.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <utility>

namespace parity::base {

namespace {

// 1: libtiff shall tell nobody else.
int keepQuiet(TIFF* /*tiff*/, void* hasMessage, const char* /*where*/, const char* /*format*/, va_list /*arguments*/) {
  *static_cast<bool*>(hasMessage) = true;
  return 1;
}

std::uint16_t shortOf(TIFF* tiff, std::uint32_t tag) {
  std::uint16_t value = 0;
  return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : std::uint16_t{0};
}

// By these the image library describes the picture in ways of its own.
bool hasSpecialTags(TIFF* tiff) {
  constexpr std::array kTags{TIFFTAG_XMLPACKET,
                             TIFFTAG_RICHTIFFIPTC,
                             TIFFTAG_PRIMARYCHROMATICITIES,
                             TIFFTAG_PIXAR_IMAGEFULLWIDTH,
                             TIFFTAG_PIXAR_IMAGEFULLLENGTH,
                             TIFFTAG_PIXAR_TEXTUREFORMAT,
                             TIFFTAG_COLORMAP,
                             TIFFTAG_SUBIFD};
  for (const int tag : kTags) {
    std::array<std::uint64_t, 4> value{}, more{}, last{}; // a tag's getter writes up to three values
    if (TIFFGetField(tiff, static_cast<std::uint32_t>(tag), value.data(), more.data(), last.data())) return true;
  }
  for (const std::uint32_t tag : {std::uint32_t{TIFFTAG_XPOSITION}, std::uint32_t{TIFFTAG_YPOSITION}}) {
    float place = 0;
    if (TIFFGetField(tiff, tag, &place) && place != 0) return true;
  }
  return false;
}

bool isWithin(const ImageLimits& limits, std::uint32_t width, std::uint32_t height) {
  const std::size_t side = std::min<std::size_t>(limits.maxSide, kMaxImageSide);
  return width > 0 && height > 0 && width <= side && height <= side &&
         std::size_t{width} * height <= std::min(limits.maxPixels, kMaxImagePixels);
}

// Of the samples: type and meaning.
bool findSamples(TIFF* tiff, TiffLayout& layout) {
  const int bits = shortOf(tiff, TIFFTAG_BITSPERSAMPLE), format = shortOf(tiff, TIFFTAG_SAMPLEFORMAT);
  const bool isFloat = bits == 32 && format == SAMPLEFORMAT_IEEEFP;
  if (!isFloat && !(format == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16))) return false;
  layout.sampleBytes = bits / 8;
  layout.info.integer = !isFloat;
  layout.info.bits = bits;

  std::uint16_t photometric = 0;
  if (!TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric)) return false;
  const int colors = photometric == PHOTOMETRIC_RGB ? 3 : photometric == PHOTOMETRIC_MINISBLACK ? 1 : 0;
  layout.channels = shortOf(tiff, TIFFTAG_SAMPLESPERPIXEL);
  if (colors == 0 || layout.channels < colors || layout.channels > colors + 1) return false;
  layout.info.channelNames = colors == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  std::uint16_t extraCount = 0;
  std::uint16_t* extras = nullptr;
  if (!TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extraCount, &extras)) extraCount = 0;
  if (extraCount != layout.channels - colors) return false;
  if (extraCount == 0) return true;
  // What is not said to be alpha, the image library takes for it in some pictures.
  if (extras[0] != EXTRASAMPLE_ASSOCALPHA && extras[0] != EXTRASAMPLE_UNASSALPHA) return false;
  layout.info.channelNames.emplace_back("A");
  layout.info.alphaChannel = colors;
  layout.info.alphaAssociated = extras[0] == EXTRASAMPLE_ASSOCALPHA;
  return true;
}

bool findParts(TIFF* tiff, TiffLayout& layout) {
  layout.isTiled = TIFFIsTiled(tiff) != 0;
  layout.isSeparate = shortOf(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE && layout.channels > 1;
  std::uint32_t width = static_cast<std::uint32_t>(layout.width), height = 0;
  if (layout.isTiled) {
    if (!TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width) || !TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height))
      return false;
    std::uint32_t depth = 1;
    if (TIFFGetField(tiff, TIFFTAG_TILEDEPTH, &depth) && depth != 1) return false;
  } else {
    if (!TIFFGetField(tiff, TIFFTAG_ROWSPERSTRIP, &height)) return false;
    if (height > kMaxImageSide) return false; // "all": the image library counts lines in its own way
    height = std::min(height, static_cast<std::uint32_t>(layout.height));
  }
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) return false;
  layout.partWidth = static_cast<int>(width), layout.partHeight = static_cast<int>(height);
  layout.across = (layout.width + layout.partWidth - 1) / layout.partWidth;
  layout.down = (layout.height + layout.partHeight - 1) / layout.partHeight;
  // Of these the image library refuses some that are sound.
  if (layout.isSeparate && !layout.isTiled && layout.compression != COMPRESSION_NONE) return false;
  // As libtiff counts, which all later reading rests on.
  const auto parts = static_cast<std::uint32_t>(layout.across * layout.down * layout.planes());
  const auto lineBytes = static_cast<tmsize_t>(layout.partWidth) * layout.partChannels() * layout.sampleBytes;
  return layout.isTiled ? TIFFNumberOfTiles(tiff) == parts && TIFFTileSize(tiff) == lineBytes * layout.partHeight
                        : TIFFNumberOfStrips(tiff) == parts && TIFFScanlineSize(tiff) == lineBytes;
}

} // namespace

TiffFile::TiffFile(const std::filesystem::path& file) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (!options) return;
  TIFFOpenOptionsSetErrorHandlerExtR(options, keepQuiet, &m_hasMessage);
  TIFFOpenOptionsSetWarningHandlerExtR(options, keepQuiet, &m_hasMessage);
  m_tiff = TIFFOpenExt(file.c_str(), "rm", options); // m: not mapped, since the file may become shorter
  TIFFOpenOptionsFree(options);
}

TiffFile::~TiffFile() {
  if (m_tiff) TIFFClose(m_tiff);
}

bool TiffFile::takeMessage() { return std::exchange(m_hasMessage, false); }

std::optional<TiffLayout> readTiffLayout(TIFF* tiff, const ImageLimits& limits) {
  TiffLayout layout;
  std::uint32_t width = 0, height = 0, depth = 1;
  if (!TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width) || !TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height) ||
      !isWithin(limits, width, height))
    return std::nullopt;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEDEPTH, &depth) && depth != 1) return std::nullopt;
  layout.width = static_cast<int>(width), layout.height = static_cast<int>(height);
  layout.compression = shortOf(tiff, TIFFTAG_COMPRESSION);
  constexpr std::array kCompressions{COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_PACKBITS, COMPRESSION_DEFLATE,
                                     COMPRESSION_ADOBE_DEFLATE};
  if (std::find(kCompressions.begin(), kCompressions.end(), layout.compression) == kCompressions.end() ||
      shortOf(tiff, TIFFTAG_FILLORDER) != FILLORDER_MSB2LSB || !TIFFLastDirectory(tiff) || hasSpecialTags(tiff))
    return std::nullopt;
  if (!findSamples(tiff, layout) || !findParts(tiff, layout)) return std::nullopt;
  layout.info.fullWidth = layout.width, layout.info.fullHeight = layout.height;
  std::uint16_t orientation = 0;
  if (TIFFGetField(tiff, TIFFTAG_ORIENTATION, &orientation)) layout.info.orientation = orientation;
  return layout;
}

} // namespace parity::base
