#include "base/image/tiff_part.h"

#include <optional>

#include <libdeflate.h>

namespace parity::base {

TiffPartReader::TiffPartReader(const std::filesystem::path& file, const TiffLayout& layout, const ImageLimits& limits)
    : m_file(file), m_layout(layout), m_inflate(libdeflate_alloc_decompressor()) {
  if (!m_file.get() || !m_inflate) return;
  const std::optional<TiffLayout> own = readTiffLayout(m_file.get(), limits);
  m_isReady = own && own->partWidth == layout.partWidth && own->partHeight == layout.partHeight &&
              own->width == layout.width && own->height == layout.height && own->channels == layout.channels &&
              own->sampleBytes == layout.sampleBytes && own->isTiled == layout.isTiled &&
              own->isSeparate == layout.isSeparate && own->compression == layout.compression;
  m_file.takeMessage(); // unknown tags are no damage
}

TiffPartReader::~TiffPartReader() {
  if (m_inflate) libdeflate_free_decompressor(m_inflate);
}

bool TiffPartReader::isLarge(const TiffPart& part) const {
  constexpr std::uint64_t kMostPacked = 1400; // no compression here packs so much into one byte
  const std::uint64_t bytes = TIFFGetStrileByteCount(m_file.get(), part.index), whole = bytesOf(part);
  return m_layout.compression == COMPRESSION_NONE ? bytes >= whole
                                                  : bytes <= 2 * whole + 4096 && bytes >= whole / kMostPacked;
}

bool TiffPartReader::unpack(const TiffPart& part, std::uint8_t* to) {
  const std::size_t bytes = bytesOf(part);
  const auto size = static_cast<tmsize_t>(bytes);
  TIFF* tiff = m_file.get();
  bool isWhole = false;
  if (m_layout.compression == COMPRESSION_PACKBITS && !m_layout.isTiled)
    isWhole = readLines(part, to);
  else if (m_layout.compression == COMPRESSION_DEFLATE || m_layout.compression == COMPRESSION_ADOBE_DEFLATE)
    isWhole =
        readRaw(part.index) && inflatesTo(bytes) &&
        TIFFReadFromUserBuffer(tiff, part.index, m_raw.data(), static_cast<tmsize_t>(m_raw.size()), to, size) != 0;
  else
    isWhole = size == (m_layout.isTiled ? TIFFReadEncodedTile(tiff, part.index, to, size)
                                        : TIFFReadEncodedStrip(tiff, part.index, to, size));
  return isWhole && !m_file.takeMessage();
}

std::size_t TiffPartReader::bytesOf(const TiffPart& part) const {
  const std::size_t line = static_cast<std::size_t>(m_layout.partWidth) *
                           static_cast<std::size_t>(m_layout.partChannels() * m_layout.sampleBytes);
  return line * static_cast<std::size_t>(m_layout.isTiled ? m_layout.partHeight : part.height);
}

// Only so is a run across lines an error, which the format forbids.
bool TiffPartReader::readLines(const TiffPart& part, std::uint8_t* to) {
  const std::size_t line = bytesOf(part) / static_cast<std::size_t>(part.height);
  const auto plane = static_cast<std::uint16_t>(static_cast<int>(part.index) / m_layout.down);
  for (int y = 0; y < part.height; ++y, to += line)
    if (TIFFReadScanline(m_file.get(), to, static_cast<std::uint32_t>(part.y + y), plane) != 1) return false;
  return true;
}

bool TiffPartReader::readRaw(std::uint32_t index) {
  m_raw.resize(static_cast<std::size_t>(TIFFGetStrileByteCount(m_file.get(), index)));
  const auto size = static_cast<tmsize_t>(m_raw.size());
  return size > 0 && size == (m_layout.isTiled ? TIFFReadRawTile(m_file.get(), index, m_raw.data(), size)
                                               : TIFFReadRawStrip(m_file.get(), index, m_raw.data(), size));
}

// Not more and not less, with the right checksum: libtiff lets more pass.
bool TiffPartReader::inflatesTo(std::size_t bytes) {
  if (m_raw.size() > bytes + bytes / 4096 + 13) return false; // of these the image library reads a part only
  m_inflated.resize(bytes);
  return libdeflate_zlib_decompress(m_inflate, m_raw.data(), m_raw.size(), m_inflated.data(), bytes, nullptr) ==
         LIBDEFLATE_SUCCESS;
}

} // namespace parity::base
