// A folder of blobs kept between runs: content-addressed, bounded, safe to delete at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace parity::base {

// What a cache folder holds: the entries of one kind, which is what stands before a key's first '-'.
struct CacheKind {
  std::string name; // "scene"; "other" for keys without a kind, and for what a killed process has left
  std::size_t entries = 0;
  std::uintmax_t bytes = 0; // headers included
};

struct CacheContents {
  std::vector<CacheKind> kinds; // by name; none is empty
  std::size_t entries = 0;
  std::uintmax_t bytes = 0;
};

// One file a key. Any number of threads and processes may use the same folder at the same time: entries are written
// under a temporary name and renamed, and carry a checksum over key and content. Nothing here throws for a file system
// that fails: a cache that cannot be read is a miss, and whatever is wrong with it is one warning a run.
class Cache {
public:
  static constexpr std::uintmax_t kDefaultMaxBytes = std::uintmax_t{4} << 30;

  // The folder is made by the first store. maxBytes bounds the sum of all entries, headers included.
  explicit Cache(std::filesystem::path folder, std::uintmax_t maxBytes = kDefaultMaxBytes);
  // Finds nothing and stores nothing (--no-cache).
  static Cache disabled();
  bool enabled() const { return !m_folder.empty(); }
  const std::filesystem::path& folder() const { return m_folder; }

  // The bytes stored under this key, which count as used now; nothing where there are none. An entry that is damaged or
  // belongs to another key is nothing, and stays until store() replaces it: on a network file system a whole entry may
  // look empty while another machine renames it. key: 1 to 128 of [0-9a-zA-Z_-], as base::Hasher::hex() makes it.
  std::optional<std::vector<std::byte>> find(const std::string& key) const;

  // Whether nothing is stored: find() need not be asked.
  bool isEmpty() const;

  // Keeps the bytes, then removes the entries used longest ago until the folder is within maxBytes. More bytes than
  // that are not stored. Returns whether it could keep them.
  bool store(const std::string& key, std::span<const std::byte> bytes) const;

  // What lies there now; empty where there is no such folder. Throws Error (exit 4) where the folder cannot be listed.
  CacheContents describe() const;
  // Removes all entries, and nothing else from the folder; returns what was removed. Throws Error (exit 4) where
  // something stays.
  CacheContents clear() const;

private:
  std::filesystem::path fileOf(const std::string& key) const;
  void evictAllBut(const std::filesystem::path& kept) const;
  void reportOnce(const std::string& message) const;

  std::filesystem::path m_folder; // empty: disabled
  std::uintmax_t m_maxBytes;
  std::shared_ptr<std::atomic<bool>> m_reported = std::make_shared<std::atomic<bool>>(false);
};

} // namespace parity::base
