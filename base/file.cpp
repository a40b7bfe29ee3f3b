// Reading and writing whole files: limits before memory is taken, no half-written results.
#include "base/file.h"

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/temporary_name.h"
#include "base/write_pieces.h"

namespace parity::base {

namespace {

namespace fs = std::filesystem;

std::string reasonOf(int errorNumber) { return std::generic_category().message(errorNumber); }

std::string kindOf(fs::file_type type) {
  return type == fs::file_type::directory ? "is a folder" : "is not a regular file";
}

class OpenFile {
public:
  OpenFile(const fs::path& file, int flags)
      : m_file(file), m_descriptor(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {
    if (m_descriptor < 0) fail("cannot be opened", errno);
  }
  ~OpenFile() {
    if (m_descriptor >= 0) ::close(m_descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  struct stat status() const {
    struct stat result {};
    if (::fstat(m_descriptor, &result) != 0) fail("cannot be examined", errno);
    return result;
  }

  // Returns how many bytes there were, at most `count`.
  std::size_t read(char* to, std::size_t count) const {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = ::read(m_descriptor, to + done, count - done);
      if (got == 0) break;
      if (got > 0)
        done += static_cast<std::size_t>(got);
      else if (errno != EINTR)
        fail("cannot be read", errno);
    }
    return done;
  }

  void write(const char* from, std::size_t count) const {
    while (count > 0) {
      const ssize_t put = ::write(m_descriptor, from, count);
      if (put >= 0)
        from += put, count -= static_cast<std::size_t>(put);
      else if (errno != EINTR)
        fail("cannot be written", errno);
    }
  }

  // Until it is on the disk.
  void sync() const {
    if (::fsync(m_descriptor) != 0 && errno != EINVAL) fail("cannot be written", errno);
  }

  // Some file systems report a full disk only here.
  void close() {
    const int descriptor = std::exchange(m_descriptor, -1);
    if (::close(descriptor) != 0) fail("cannot be written", errno);
  }

private:
  [[noreturn]] void fail(const char* what, int errorNumber) const {
    throw fileError(m_file.string(), what, reasonOf(errorNumber));
  }

  fs::path m_file;
  int m_descriptor;
};

template <typename Container> Container readWhole(const fs::path& file, std::size_t maxBytes) {
  regularFileSize(file);                            // before opening: that would wait on a pipe without a writer
  const OpenFile open(file, O_RDONLY | O_NONBLOCK); // it may have become one since
  const struct stat status = open.status();
  if (!S_ISREG(status.st_mode)) throw fileError(file.string(), "", "is not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > maxBytes) throw fileError(file.string(), "", fmt::format("has {} bytes; the limit is {}", size, maxBytes));
  Container content(size, typename Container::value_type{});
  if (open.read(reinterpret_cast<char*>(content.data()), size) != size)
    throw fileError(file.string(), "", "became shorter while it was read");
  return content;
}

} // namespace

std::uintmax_t regularFileSize(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw fileError(file.string(), "", "does not exist");
  if (error) throw fileError(file.string(), "cannot be examined", error.message());
  if (status.type() != fs::file_type::regular) throw fileError(file.string(), "", kindOf(status.type()));
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw fileError(file.string(), "cannot be examined", error.message());
  return size;
}

std::vector<std::byte> readFile(const fs::path& file, std::size_t maxBytes) {
  return readWhole<std::vector<std::byte>>(file, maxBytes);
}

std::string readText(const fs::path& file, std::size_t maxBytes) { return readWhole<std::string>(file, maxBytes); }

void writeAtomically(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  std::error_code error;
  fs::path target = file;
  if (fs::is_symlink(file, error))
    if (fs::path linked = fs::canonical(file, error); !error) target = linked;
  // A device such as /dev/null would be replaced by the rename, not written to.
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw fileError(file.string(), "cannot be written", kindOf(status.type()));
  if (!target.has_filename()) throw fileError(file.string(), "cannot be written", "is not a file name");
  if (const fs::path folder = target.parent_path(); !folder.empty()) {
    fs::create_directories(folder, error);
    if (error) throw fileError(file.string(), "its folder cannot be created", error.message());
  }

  // Beside the target, so that the rename stays on one file system; with the same extension, by which image libraries
  // choose the format.
  const fs::path temporary = target.parent_path() / temporaryNameOf(target.filename().string());
  try {
    write(temporary);
    fs::rename(temporary, target, error);
    if (error) throw fileError(file.string(), "cannot be written", error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

void writeText(const fs::path& file, std::string_view text) { writeBytes(file, std::as_bytes(std::span{text})); }

void writePieces(const fs::path& file, const std::function<void(const TextSink&)>& write) {
  writeAtomically(file, [&](const fs::path& temporary) {
    const auto named = [&](const auto& step) {
      try {
        step();
      } catch (const Error& error) { // the reader knows the final name only
        throw Error(error.code(), file.string(), error.place(), error.reason());
      }
    };
    std::optional<OpenFile> open;
    named([&] { open.emplace(temporary, O_WRONLY | O_CREAT | O_EXCL); });
    write([&](std::string_view piece) { named([&] { open->write(piece.data(), piece.size()); }); });
    named([&] { open->close(); });
  });
}

namespace {

// Writes the bytes to a temporary file beside this one, until they are on the disk, gives it to `place`, which answers
// with an errno or 0, and removes what is left of it. Returns the answer.
int writeAndPlace(const fs::path& file, std::span<const std::byte> bytes,
                  const std::function<int(const fs::path& temporary)>& place) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw fileError(file.string(), "its folder cannot be created", error.message());
  const fs::path temporary = file.parent_path() / temporaryNameOf(file.filename().string());
  try {
    OpenFile open(temporary, O_WRONLY | O_CREAT | O_EXCL);
    open.write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    open.sync();
    open.close();
  } catch (const Error& failure) {
    fs::remove(temporary, error);
    throw Error(failure.code(), file.string(), failure.place(), failure.reason());
  }
  const int answer = place(temporary);
  fs::remove(temporary, error);
  if (answer != 0 && answer != EEXIST) throw fileError(file.string(), "cannot be written", reasonOf(answer));
  if (const int folder = ::open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); folder >= 0) {
    ::fsync(folder); // the name, too; not every file system can
    ::close(folder);
  }
  return answer;
}

} // namespace

bool writeOnce(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code error;
  if (fs::exists(file, error)) return false;
  return writeAndPlace(file, bytes, [&](const fs::path& temporary) {
           const int number = ::link(temporary.c_str(), file.c_str()) == 0 ? 0 : errno;
           if (number != EPERM && number != EOPNOTSUPP && number != ENOSYS) return number;
           return ::rename(temporary.c_str(), file.c_str()) == 0 ? 0 : errno; // without links: the last one wins
         }) == 0;
}

void replaceDurably(const fs::path& file, std::span<const std::byte> bytes) {
  writeAndPlace(file, bytes,
                [&](const fs::path& temporary) { return ::rename(temporary.c_str(), file.c_str()) == 0 ? 0 : errno; });
}

void writeBytes(const fs::path& file, std::span<const std::byte> bytes) {
  writePieces(file, [&](const TextSink& sink) { sink({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); });
}

fs::path defaultCacheFolder() {
  // The XDG base directory specification: a relative path there is to be ignored.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute())
    return fs::path(cache) / "parity";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "parity";
  throw fileError("cache", "", "its place is unknown: set XDG_CACHE_HOME or HOME, or give --cache");
}

} // namespace parity::base
