// Whether this program's own readers read what the image library reads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace parity::base {

enum class OwnReader {
  reads,    // and it must
  mayRefuse // then the library is asked, so that nothing can differ
};

// Fails the test unless our reader of PNG, Radiance HDR or OpenEXR, by the first bytes, gives all that the library
// gives, bit for bit, or refuses. True where it has read the file.
bool expectAsLibrary(const std::filesystem::path& file, std::span<const std::byte> bytes,
                     OwnReader own = OwnReader::reads);

// The same of TIFF.
bool expectTiffAsLibrary(std::span<const std::byte> bytes, OwnReader own = OwnReader::reads);

} // namespace parity::base
