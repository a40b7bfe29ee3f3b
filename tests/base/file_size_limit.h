// A disk that is full, as far as this process can tell: files may not grow beyond a limit.
#pragma once

#include <csignal>

#include <sys/resource.h>

namespace parity::base {

// While it lives, write() fails beyond `bytes` (EFBIG).
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : m_handler(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &m_before);
    rlimit limit = m_before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &m_before);
    std::signal(SIGXFSZ, m_handler);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  void (*m_handler)(int);
  rlimit m_before{};
};

} // namespace parity::base
