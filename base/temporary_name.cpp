#include "base/temporary_name.h"

#include <atomic>
#include <filesystem>
#include <random>
#include <string_view>

#include <fmt/format.h>

namespace parity::base {

namespace {

bool isDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

} // namespace

std::string temporaryNameOf(const std::string& fileName) {
  // Not the process id: two machines that share a folder may have the same.
  static const unsigned process = std::random_device{}();
  static std::atomic<unsigned> counter = 0;
  const std::filesystem::path file = fileName;
  return fmt::format(".{}.{}-{}{}", file.stem().string(), process, counter++, file.extension().string());
}

std::optional<std::string> ownNameOf(const std::string& temporaryName) {
  // ".stem.ID-N" and an extension, or none, which then is what ID-N looks like.
  const std::string extension = std::filesystem::path(temporaryName).extension().string();
  for (const std::string& last : {extension, std::string()}) {
    const std::string inner = temporaryName.substr(0, temporaryName.size() - last.size());
    const std::size_t dot = inner.rfind('.');
    if (!inner.starts_with('.') || dot == 0) continue;
    const std::string_view number = std::string_view(inner).substr(dot + 1);
    const std::size_t dash = number.find('-');
    if (dash == std::string_view::npos || !isDigits(number.substr(0, dash)) || !isDigits(number.substr(dash + 1)))
      continue;
    return inner.substr(1, dot - 1) + last;
  }
  return std::nullopt;
}

} // namespace parity::base
