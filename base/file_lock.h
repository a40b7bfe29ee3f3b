// A lock file: one process at a time does what it guards.
#pragma once

#include <filesystem>
#include <string>

namespace parity::base {

// Held from the constructor to the destructor; the file stays. On a file system that is read-only or knows no locks
// nothing is locked.
class FileLock {
public:
  // subject, reason: of the Error (exit 75) where another process holds it.
  FileLock(const std::filesystem::path& file, const std::string& subject, const std::string& reason);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

private:
  int m_descriptor;
};

} // namespace parity::base
