// How much memory comparing a pair of pictures takes, by their headers.
#pragma once

#include <cstddef>
#include <filesystem>

#include "base/image/image_io.h"
#include "compare/images/flip_run.h"

namespace parity::compare {

// An upper bound of the bytes that are held at a time: while both pictures are read, or while they are measured.
std::size_t estimateFlipBytes(const base::ImageShape& reference, const base::ImageShape& test,
                              const FlipRequest& request);

// Reads the headers alone. Throws Error (exit 4) for a file that cannot be read or is beyond request.image.limits, and
// where the pair takes more than their maxBytes.
void requireFlipMemory(const FlipRequest& request, const FilePair& files);

} // namespace parity::compare
