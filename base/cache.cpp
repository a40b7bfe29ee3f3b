// A folder of blobs kept between runs: checksummed files, evicted by the time of their last use.
#include "base/cache.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"

namespace parity::base {

namespace {

namespace fs = std::filesystem;

// Only files of this extension are ever counted or removed: --cache may name a folder that holds other things. The
// temporary files of a process that was killed bear it too, and so grow old and go.
constexpr const char* kExtension = ".parity-blob";
constexpr std::string_view kBlobMagic = "PARITYB1";

// What stands before the content, in the machine's byte order: an entry of another machine fails the size check.
struct BlobHeader {
  char magic[8];
  std::uint64_t contentBytes;
  char checksum[32]; // Hasher of key and content
};
static_assert(sizeof(BlobHeader) == 48);

BlobHeader makeHeader(const std::string& key, std::span<const std::byte> content) {
  BlobHeader header{};
  std::memcpy(header.magic, kBlobMagic.data(), sizeof header.magic);
  header.contentBytes = content.size();
  const std::string checksum = Hasher().add(key).add(content).hex();
  assert(checksum.size() == sizeof header.checksum);
  std::memcpy(header.checksum, checksum.data(), sizeof header.checksum);
  return header;
}

bool isWhole(const std::string& key, std::span<const std::byte> file) {
  if (file.size() < sizeof(BlobHeader)) return false;
  const BlobHeader expected = makeHeader(key, file.subspan(sizeof(BlobHeader)));
  return std::memcmp(&expected, file.data(), sizeof expected) == 0;
}

bool isKeyCharacter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
}

struct Entry {
  fs::file_time_type lastUse;
  fs::path file;
  std::uintmax_t size;
};

// What other processes remove or replace meanwhile is left out.
std::vector<Entry> listEntries(const fs::path& folder, std::error_code& error) {
  std::vector<Entry> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != kExtension) continue;
    std::error_code gone;
    if (!it->is_regular_file(gone) || it->is_symlink(gone)) continue;
    Entry entry{it->last_write_time(gone), it->path(), 0};
    if (gone) continue;
    entry.size = it->file_size(gone);
    if (!gone) entries.push_back(std::move(entry));
  }
  return entries;
}

// Of writeBytes: of another process that is writing, or of one that was killed.
bool isTemporary(const fs::path& file) { return file.filename().string().starts_with('.'); }
constexpr std::chrono::minutes kLongestWrite{10};

std::string kindOf(const fs::path& file) {
  const std::string key = file.stem().string();
  const std::size_t dash = key.find('-');
  return isTemporary(file) || dash == std::string::npos ? "other" : key.substr(0, dash);
}

// Kind and first digits: enough to tell entries apart.
std::string shortOf(const std::string& key) { return key.substr(0, key.find('-') + 9); }

CacheContents summarize(const std::vector<Entry>& entries) {
  std::map<std::string, CacheKind> kinds;
  CacheContents contents;
  for (const Entry& entry : entries) {
    CacheKind& kind = kinds[kindOf(entry.file)];
    ++kind.entries;
    kind.bytes += entry.size;
    ++contents.entries;
    contents.bytes += entry.size;
  }
  for (auto& [name, kind] : kinds) contents.kinds.push_back({name, kind.entries, kind.bytes});
  return contents;
}

} // namespace

Cache::Cache(fs::path folder, std::uintmax_t maxBytes) : m_folder(std::move(folder)), m_maxBytes(maxBytes) {}

Cache Cache::disabled() { return Cache({}, 0); }

fs::path Cache::fileOf(const std::string& key) const {
  assert(!key.empty() && key.size() <= 128 && std::all_of(key.begin(), key.end(), isKeyCharacter));
  return m_folder / (key + kExtension);
}

std::optional<std::vector<std::byte>> Cache::find(const std::string& key) const {
  if (!enabled()) return std::nullopt;
  const fs::path file = fileOf(key);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    logDetail(fmt::format("cache: {} is not there", shortOf(key)));
    return std::nullopt;
  }
  std::vector<std::byte> bytes;
  try {
    bytes = readFile(file);
  } catch (const Error& unreadable) { // or removed by another process just now
    if (fs::exists(file, error)) reportOnce(std::string("cache: ") + unreadable.what());
    return std::nullopt;
  }
  if (!isWhole(key, bytes)) {
    reportOnce("cache: a damaged entry is not used: " + file.string());
    return std::nullopt;
  }
  fs::last_write_time(file, fs::file_time_type::clock::now(), error); // a folder that is read-only still serves
  bytes.erase(bytes.begin(), bytes.begin() + sizeof(BlobHeader));
  logDetail(fmt::format("cache: {} is taken, {} bytes", shortOf(key), bytes.size()));
  return bytes;
}

bool Cache::store(const std::string& key, std::span<const std::byte> bytes) const {
  if (!enabled()) return false;
  const fs::path file = fileOf(key);
  if (const std::uintmax_t most = std::min<std::uintmax_t>(m_maxBytes, kMaxFileBytes);
      bytes.size() > most || most - bytes.size() < sizeof(BlobHeader)) {
    reportOnce("cache: an entry was not stored, because it is larger than the whole cache: " + file.string());
    return false;
  }
  const BlobHeader header = makeHeader(key, bytes);
  std::vector<std::byte> content(sizeof header + bytes.size());
  std::memcpy(content.data(), &header, sizeof header);
  if (!bytes.empty()) std::memcpy(content.data() + sizeof header, bytes.data(), bytes.size());
  try {
    writeBytes(file, content);
  } catch (const Error& unwritable) {
    reportOnce(std::string("cache: ") + unwritable.what());
    return false;
  }
  logDetail(fmt::format("cache: {} is kept, {} bytes", shortOf(key), bytes.size()));
  evictAllBut(file);
  return true;
}

void Cache::evictAllBut(const fs::path& kept) const {
  std::error_code unlisted;
  std::vector<Entry> entries = listEntries(m_folder, unlisted);
  // Files that another process is about to rename are left alone, and count when they have become entries.
  const auto writtenSince = fs::file_time_type::clock::now() - kLongestWrite;
  std::erase_if(entries, [&](const Entry& e) { return isTemporary(e.file) && e.lastUse > writtenSince; });
  std::uintmax_t sum = 0;
  for (const Entry& entry : entries) sum += entry.size;
  if (sum <= m_maxBytes) return;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.lastUse != b.lastUse ? a.lastUse < b.lastUse : a.file < b.file;
  });
  for (const Entry& entry : entries) {
    if (sum <= m_maxBytes) break;
    if (entry.file == kept) continue;
    std::error_code error;
    fs::remove(entry.file, error); // gone already: another process evicts as well
    if (error) continue;
    logDetail(fmt::format("cache: {} is removed to make room", shortOf(entry.file.stem().string())));
    sum -= entry.size;
  }
}

bool Cache::isEmpty() const {
  std::error_code error;
  return !enabled() || !fs::exists(m_folder, error) || fs::is_empty(m_folder, error);
}

CacheContents Cache::describe() const {
  std::error_code error;
  if (!enabled() || !fs::exists(m_folder, error)) return {};
  const std::vector<Entry> entries = listEntries(m_folder, error);
  if (error) throw fileError(m_folder.string(), "the cache cannot be listed", error.message());
  return summarize(entries);
}

CacheContents Cache::clear() const {
  std::error_code error;
  if (!enabled() || !fs::exists(m_folder, error)) return {};
  const std::vector<Entry> entries = listEntries(m_folder, error);
  if (error) throw fileError(m_folder.string(), "the cache cannot be listed", error.message());
  for (const Entry& entry : entries) {
    fs::remove(entry.file, error); // no error where it is gone already
    if (error) throw fileError(entry.file.string(), "cannot be removed", error.message());
  }
  return summarize(entries);
}

void Cache::reportOnce(const std::string& message) const {
  if (!m_reported->exchange(true)) logWarning(message);
}

} // namespace parity::base
