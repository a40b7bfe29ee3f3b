// Reading and writing whole files: limits before memory is taken, no half-written results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace parity::base {

inline constexpr std::size_t kMaxFileBytes = std::size_t{2} << 30;

// Bytes of a regular file. Throws Error (exit 4) where it is missing, no regular file or out of reach.
std::uintmax_t regularFileSize(const std::filesystem::path& file);

// Throw Error (exit 4) where the file is missing, not a regular file, unreadable or larger than maxBytes.
std::vector<std::byte> readFile(const std::filesystem::path& file, std::size_t maxBytes = kMaxFileBytes);
std::string readText(const std::filesystem::path& file, std::size_t maxBytes = kMaxFileBytes);

// Calls `write` with a temporary path beside `file` (same extension), then renames it; removes it if `write` throws.
// Makes the parent folder; a link is followed. Throws Error (exit 4), and what `write` throws.
void writeAtomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);
void writeText(const std::filesystem::path& file, std::string_view text);
void writeBytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

// Writes a file that is not there yet, and returns true once it is on the disk, whole; false where one of that name is
// there, which stays. Of several writers, also on other machines, one wins. Makes the parent folder. Throws Error (exit
// 4).
bool writeOnce(const std::filesystem::path& file, std::span<const std::byte> bytes);
// The same in place of a file of that name.
void replaceDurably(const std::filesystem::path& file, std::span<const std::byte> bytes);

// $XDG_CACHE_HOME/parity, or ~/.cache/parity. Throws Error (exit 4) where neither variable is set.
std::filesystem::path defaultCacheFolder();

} // namespace parity::base
