// A file from pieces of text: for what is too long to be held.
#pragma once

#include <filesystem>
#include <functional>

#include "base/text/text_sink.h"

namespace parity::base {

// Writes what `write` gives the sink, one piece behind the other, as writeText writes a text (base/file.h): beside the
// file at first, and renamed once it is whole. Throws Error (exit 4), and what `write` throws.
void writePieces(const std::filesystem::path& file, const std::function<void(const TextSink&)>& write);

} // namespace parity::base
