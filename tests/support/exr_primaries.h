// An OpenEXR file that declares its primaries.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace parity::tests {

// bytes: an EXR of a single chunk, whose place in the file moves on by what is inserted. xy: of red, green, blue,
// white.
inline std::string withPrimaries(std::string bytes, const std::array<float, 8>& xy) {
  std::string attribute("chromaticities\0chromaticities\0\x20\0\0\0", 34);
  attribute.append(reinterpret_cast<const char*>(xy.data()), sizeof xy);
  std::size_t at = 8; // behind magic and version: name, type, size, value, and a zero at the end
  while (bytes.at(at) != 0) {
    at = bytes.find('\0', bytes.find('\0', at) + 1) + 1;
    std::int32_t size = 0;
    std::memcpy(&size, bytes.data() + at, 4);
    at += 4 + static_cast<std::size_t>(size);
  }
  std::uint64_t offset = 0;
  std::memcpy(&offset, bytes.data() + at + 1, 8);
  offset += attribute.size();
  std::memcpy(bytes.data() + at + 1, &offset, 8);
  return bytes.insert(8, attribute);
}

} // namespace parity::tests
