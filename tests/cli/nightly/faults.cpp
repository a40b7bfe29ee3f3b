// A library for LD_PRELOAD that makes `parity` fail as a bad driver, a full disk or a wrong clock would.
//
// PARITY_FAULTS: "KIND PATTERN" pairs, separated by ';'. A fault happens when a file whose name matches the pattern (of
// fnmatch) is opened:
//   segv, abort, exit   ends the worker
//   kill, term          ends it by SIGKILL or SIGTERM; parent: its supervisor by SIGKILL
//   stop                stops it, as SIGSTOP does
//   memory              takes memory until somebody ends the worker
//   full                the pattern is the name of a folder: no file can be created below it
//   late                ends the worker as it exits, after its work
// PARITY_FAULTS_ONCE: a folder; each fault happens once there, whichever process meets it. Without it, always.
// PARITY_FAULTS_LOG: a file that gets a line "PID FILE" for each *.gltf that a worker opens.
// PARITY_FAULTS_CLOCK: the time of day jumps by up to a year either way.
// Workers alone meet faults (their command line has "--worker"), but `full` and the clock, which all processes meet.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

namespace {

bool isWorker() {
  static const bool is = [] {
    std::string words;
    if (std::FILE* file = std::fopen("/proc/self/cmdline", "re")) {
      char buffer[4096];
      for (std::size_t count; (count = std::fread(buffer, 1, sizeof(buffer), file)) > 0;) words.append(buffer, count);
      std::fclose(file);
    }
    return words.find(std::string_view("\0--worker\0", 10)) != std::string::npos;
  }();
  return is;
}

// False where it has happened before.
bool isFirst(const std::string& fault) {
  const char* folder = std::getenv("PARITY_FAULTS_ONCE");
  if (!folder) return true;
  std::string name = fault;
  for (char& c : name)
    if (c == ' ' || c == '/') c = '_';
  return ::mkdir((std::string(folder) + "/" + name).c_str(), 0700) == 0;
}

void happen(std::string_view kind) {
  std::fprintf(stderr, "the driver says: %s\n", std::string(kind).c_str());
  if (kind == "segv") {
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
  } else if (kind == "abort") {
    std::abort();
  } else if (kind == "exit") {
    ::_exit(3);
  } else if (kind == "kill") {
    std::raise(SIGKILL);
  } else if (kind == "term") {
    std::raise(SIGTERM);
  } else if (kind == "parent") {
    ::kill(::getppid(), SIGKILL);
    ::pause();
  } else if (kind == "late") {
    std::atexit([] { std::raise(SIGSEGV); });
  } else if (kind == "stop") {
    std::raise(SIGSTOP);
  } else if (kind == "memory") {
    constexpr std::size_t kPiece = std::size_t{64} << 20;
    for (std::vector<char*> pieces; pieces.size() < 64; ::usleep(20'000)) { // 4 GiB at most
      pieces.push_back(static_cast<char*>(std::malloc(kPiece)));
      std::memset(pieces.back(), 1, kPiece);
    }
    ::pause();
  }
}

void note(const char* file) {
  static const char* const log = std::getenv("PARITY_FAULTS_LOG");
  if (!log || !std::string_view(file).ends_with(".gltf") || !isWorker()) return;
  if (std::FILE* to = std::fopen(log, "ae")) {
    std::fprintf(to, "%d %s\n", static_cast<int>(::getpid()), file);
    std::fclose(to);
  }
}

// Whether there is no space for this file.
bool meetFault(const char* file, bool isCreated) {
  static const std::string faults = std::getenv("PARITY_FAULTS") ? std::getenv("PARITY_FAULTS") : "";
  if (!file) return false;
  note(file);
  const std::string path = file, name = path.substr(path.rfind('/') + 1);
  for (std::size_t at = 0; at < faults.size();) {
    const std::size_t end = std::min(faults.find(';', at), faults.size());
    const std::string fault = faults.substr(at, end - at);
    at = end + 1;
    const std::size_t space = fault.find(' ');
    const std::string kind = fault.substr(0, space), pattern = fault.substr(space + 1);
    if (kind == "full") {
      if (isCreated && path.find("/" + pattern + "/") != std::string::npos && isFirst(fault)) return true;
    } else if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0 && isWorker() && isFirst(fault)) {
      happen(kind);
    }
  }
  return false;
}

template <typename Function> Function nextOf(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

int openBy(const char* function, const char* file, int flags, mode_t mode) {
  using Open = int (*)(const char*, int, ...);
  if (meetFault(file, (flags & O_CREAT) != 0)) {
    errno = ENOSPC;
    return -1;
  }
  return nextOf<Open>(function)(file, flags, mode);
}

} // namespace

#define PARITY_OPEN(NAME)                                                                                              \
  extern "C" int NAME(const char* file, int flags, ...) {                                                              \
    va_list rest;                                                                                                      \
    va_start(rest, flags);                                                                                             \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;                               \
    va_end(rest);                                                                                                      \
    return openBy(#NAME, file, flags, mode);                                                                           \
  }
PARITY_OPEN(open)
PARITY_OPEN(open64)
#undef PARITY_OPEN

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  using Clock = int (*)(clockid_t, timespec*);
  static const Clock next = nextOf<Clock>("clock_gettime");
  static const bool jumps = std::getenv("PARITY_FAULTS_CLOCK") != nullptr;
  const int result = next(clock, time);
  constexpr long kYear = 365L * 86400;
  if (jumps && clock == CLOCK_REALTIME) time->tv_sec += (time->tv_nsec / 1000 * 7919) % (2 * kYear) - kYear;
  return result;
}
