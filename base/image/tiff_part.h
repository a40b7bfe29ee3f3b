// One strip or tile of a TIFF file, unpacked by libtiff.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/image/tiff_file.h"

struct libdeflate_decompressor;

namespace parity::base {

struct TiffPart {
  int x = 0, y = 0, width = 0, height = 0; // of the picture; a tile may reach beyond it
  std::uint32_t index = 0;                 // libtiff's number of the strip or tile
};

// Unpacks parts, one after another, with the same buffers. `layout` has to outlive it.
class TiffPartReader {
public:
  TiffPartReader(const std::filesystem::path& file, const TiffLayout& layout, const ImageLimits& limits);
  ~TiffPartReader();
  TiffPartReader(const TiffPartReader&) = delete;
  TiffPartReader& operator=(const TiffPartReader&) = delete;

  bool isReady() const { return m_isReady; } // false: the file is not the one it was

  // Whether the part may hold its samples, by how many bytes it has.
  bool isLarge(const TiffPart& part) const;

  // The samples, line by line as wide as the part, into `to`, which has room for bytesOf(part). False where the file is
  // damaged in any way.
  bool unpack(const TiffPart& part, std::uint8_t* to);
  std::size_t bytesOf(const TiffPart& part) const;

  std::vector<std::uint8_t>& buffer() { return m_buffer; } // the caller's

private:
  bool readLines(const TiffPart& part, std::uint8_t* to);
  bool readRaw(std::uint32_t index);
  bool inflatesTo(std::size_t bytes);

  TiffFile m_file;
  const TiffLayout& m_layout;
  libdeflate_decompressor* m_inflate;
  bool m_isReady = false;
  std::vector<std::uint8_t> m_raw, m_inflated, m_buffer;
};

} // namespace parity::base
