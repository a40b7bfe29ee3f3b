#include "base/text/error_words.h"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>

#include "base/error.h"

namespace parity::base {

std::string wordsOf(const std::exception& error) {
  if (dynamic_cast<const Error*>(&error)) return error.what();
  // A length beyond what a container can have is memory that was asked for, too.
  if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error))
    return "out of memory";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return (file->path1().empty() ? "" : file->path1().string() + ": ") + file->code().message();
  if (dynamic_cast<const std::out_of_range*>(&error)) return "internal error, please report it";
  std::string_view words = error.what();
  if (const auto tag = words.find("] "); words.starts_with('[') && tag != std::string_view::npos)
    words.remove_prefix(tag + 2);
  return std::string(words);
}

} // namespace parity::base
