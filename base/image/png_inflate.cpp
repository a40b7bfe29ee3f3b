// The rows of a plain PNG file (ISO/IEC 15948, sections 9 to 11) by libdeflate.
#include "base/image/png_inflate.h"

#include <memory>
#include <string_view>
#include <vector>

#include <libdeflate.h>

#include "base/image/png_filter.h"

namespace parity::base {

namespace {

constexpr std::size_t kBeforeChunks = 8, kChunkHead = 8, kChunkEnd = 4;

std::size_t lengthOf(std::string_view chunk) {
  std::size_t length = 0;
  for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(chunk[i]);
  return length;
}

// The first run of IDAT chunks: libpng takes no later one. `joined` holds the data where it is not in one piece.
std::string_view findImageData(std::string_view file, std::vector<char>& joined) {
  std::string_view found;
  for (std::size_t at = kBeforeChunks; at + kChunkHead <= file.size();) {
    const std::size_t length = lengthOf(file.substr(at));
    const bool isData = file.substr(at + 4, 4) == "IDAT";
    if (!isData && found.data()) break;
    if (length > file.size() - at - kChunkHead) return {};
    const std::string_view data = file.substr(at + kChunkHead, length);
    if (isData) {
      if (found.data() && joined.empty()) joined.assign(found.begin(), found.end());
      if (found.data()) joined.insert(joined.end(), data.begin(), data.end());
      if (!found.data()) found = data;
    }
    at += kChunkHead + length + kChunkEnd;
  }
  return joined.empty() ? found : std::string_view(joined.data(), joined.size());
}

// libpng refuses what lies farther back than the window of the header; libdeflate has the largest window always.
bool hasWholeWindow(std::string_view data, std::size_t size) {
  constexpr int kLeastBits = 8;
  return data.size() >= 2 && size <= std::size_t{1} << (kLeastBits + (static_cast<unsigned char>(data[0]) >> 4));
}
bool hasLargestWindow(std::string_view data) {
  return data.size() >= 2 && static_cast<unsigned char>(data[0]) >> 4 == 7;
}

} // namespace

bool inflatePngRows(std::span<const std::byte> file, std::span<std::uint8_t> rows, std::size_t rowBytes,
                    int pixelBytes) {
  std::vector<char> joined;
  const std::string_view data = findImageData({reinterpret_cast<const char*>(file.data()), file.size()}, joined);
  if (!hasLargestWindow(data) && !hasWholeWindow(data, rows.size())) return false;
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor || libdeflate_zlib_decompress(decompressor.get(), data.data(), data.size(), rows.data(),
                                                  rows.size(), nullptr) != LIBDEFLATE_SUCCESS)
    return false;
  const std::vector<std::uint8_t> zeros(rowBytes);
  const std::uint8_t* above = zeros.data();
  for (std::size_t at = 0; at < rows.size(); at += 1 + rowBytes) {
    if (rows[at] >= kPngFilters) return false;
    std::uint8_t* row = rows.data() + at + 1;
    unfilterRow(static_cast<PngFilter>(rows[at]), row, above, rowBytes, pixelBytes);
    above = row;
  }
  return true;
}

} // namespace parity::base
