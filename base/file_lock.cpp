#include "base/file_lock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace parity::base {

namespace {

int openLock(const std::filesystem::path& file) { return ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666); }

bool isSameFile(int descriptor, const std::filesystem::path& file) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

} // namespace

FileLock::FileLock(const std::filesystem::path& file, const std::string& subject, const std::string& reason)
    : m_descriptor(openLock(file)) {
  while (m_descriptor >= 0) {
    if (::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return; // a file system without locks
      ::close(m_descriptor);
      throw Error(ExitCode::incomplete, subject, "", reason);
    }
    if (isSameFile(m_descriptor, file)) return;
    ::close(m_descriptor); // its owner has removed it just now
    m_descriptor = openLock(file);
  }
}

FileLock::~FileLock() {
  if (m_descriptor >= 0) ::close(m_descriptor);
}

} // namespace parity::base
