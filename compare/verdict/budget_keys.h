// The keys of a budget file, and of approvals, by their types; whatever is wrong is refused with file and line. Only
// for readers of TOML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace parity::compare {

// All of these throw Error (exit 4) "file: line N: reason".
class BudgetKeys {
public:
  explicit BudgetKeys(const std::filesystem::path& file) : m_file(file.string()), m_short(file.filename().string()) {}

  [[noreturn]] void refuse(const toml::source_region& where, const std::string& reason) const;

protected:
  // The whole file. A conflict marker that a merge has left in it is called so.
  toml::table parse(std::string_view text) const;
  void refuseUnknown(const toml::table& table, std::span<const std::string_view> known) const;
  std::vector<const toml::table*> tablesOf(const toml::node& node, std::string_view key) const;
  // Never empty, unless that is the fallback.
  std::string textOf(const toml::table& table, std::string_view key, std::string fallback) const;
  // A number of pixels, at least 1; hint: what the least one means.
  std::uint64_t readPixels(const toml::node& node, const char* key, const char* hint) const;
  const std::string& fileName() const { return m_file; }
  const std::string& shortName() const { return m_short; } // without its folder

private:
  std::string m_file, m_short;
};

} // namespace parity::compare
