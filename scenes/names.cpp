// Names from files, made fit for reports.
#include "scenes/names.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/text/text.h"

namespace parity::scenes {

std::string cleanName(std::string_view name) {
  constexpr std::size_t kMaxBytes = 128;
  std::string clean = base::cleanUtf8(name.substr(0, kMaxBytes + 1)); // names of files and channels are any bytes
  for (char& c : clean)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  if (clean.size() > kMaxBytes) {
    std::size_t end = kMaxBytes - 3;
    while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xc0) == 0x80) --end; // not inside a character
    clean.resize(end);
    clean += "...";
  }
  const std::size_t first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') - first + 1);
}

bool isBuiltin(std::string_view fileOrBuiltin) { return fileOrBuiltin.starts_with(kBuiltinPrefix); }

std::string stemOf(const std::string& fileOrBuiltin) {
  return isBuiltin(fileOrBuiltin) ? fileOrBuiltin.substr(kBuiltinPrefix.size())
                                  : std::filesystem::path(fileOrBuiltin).stem().string();
}

std::string UniqueNames::make(std::string_view name, std::string_view fallback) {
  std::string base = cleanName(name);
  if (base.empty()) base = fallback;
  if (m_taken.insert(base).second) return base;
  for (int& number = m_last.try_emplace(base, 1).first->second;;) {
    std::string numbered = fmt::format("{} ({})", base, ++number);
    if (m_taken.insert(numbered).second) return numbered;
  }
}

} // namespace parity::scenes
