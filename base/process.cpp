#include "base/process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"

extern char** environ; // NOLINT: POSIX

namespace parity::base {

namespace {

constexpr int kInheritedNumber = 3;
constexpr int kLongestDeath = 2000;         // milliseconds
constexpr std::size_t kMostBytes = 1 << 16; // a call: a process that writes without end holds nobody up
constexpr std::size_t kMostAtEnd = 1 << 21;
constexpr std::size_t kLongestLine = 1 << 20; // what is longer comes in parts

[[noreturn]] void fail(const std::string& program, const char* what, int number) {
  throw fileError(program, what, std::generic_category().message(number));
}

struct PipeEnds {
  int reading = -1, writing = -1;
};

PipeEnds makePipe(const std::string& program) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(program, "pipe", errno);
  return {ends[0], ends[1]};
}

class SpawnActions {
public:
  SpawnActions() {
    ::posix_spawn_file_actions_init(&m_actions);
    ::posix_spawnattr_init(&m_attributes);
    ::posix_spawnattr_setpgroup(&m_attributes, 0);
    // Handlers do not cross exec, but what is ignored and blocked does.
    sigset_t all, none;
    ::sigemptyset(&none);
    ::sigemptyset(&all);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD}) ::sigaddset(&all, number);
    ::posix_spawnattr_setsigdefault(&m_attributes, &all);
    ::posix_spawnattr_setsigmask(&m_attributes, &none);
    ::posix_spawnattr_setflags(&m_attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnActions() {
    ::posix_spawn_file_actions_destroy(&m_actions);
    ::posix_spawnattr_destroy(&m_attributes);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  void give(int descriptor, int as) { ::posix_spawn_file_actions_adddup2(&m_actions, descriptor, as); }
  const posix_spawn_file_actions_t* actions() const { return &m_actions; }
  const posix_spawnattr_t* attributes() const { return &m_attributes; }

private:
  posix_spawn_file_actions_t m_actions{};
  posix_spawnattr_t m_attributes{};
};

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, int inherited) {
  const std::string& program = arguments.at(0);
  std::signal(SIGCHLD, SIG_DFL); // where it is ignored nobody learns how a process ended
  const PipeEnds input = makePipe(program), output = makePipe(program), error = makePipe(program);
  SpawnActions actions;
  actions.give(input.reading, STDIN_FILENO);
  actions.give(output.writing, STDOUT_FILENO);
  actions.give(error.writing, STDERR_FILENO);
  if (inherited >= 0) actions.give(inherited, kInheritedNumber);
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str())); // NOLINT: as POSIX has it
  words.push_back(nullptr);
  const int failure =
      ::posix_spawn(&m_id, program.c_str(), actions.actions(), actions.attributes(), words.data(), environ);
  for (const int end : {input.reading, output.writing, error.writing}) ::close(end);
  m_input = input.writing;
  m_output.descriptor = output.reading;
  m_error.descriptor = error.reading;
  for (const int descriptor : {m_output.descriptor, m_error.descriptor}) ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  if (failure != 0) {
    m_id = -1;
    for (const int end : {m_input, m_output.descriptor, m_error.descriptor}) ::close(end);
    fail(program, "cannot be started", failure);
  }
}

ChildProcess::~ChildProcess() {
  if (!m_end) {
    signal(SIGKILL);
    // One that hangs in the kernel cannot be killed.
    for (int i = 0; i < kLongestDeath && !end(); ++i) ::usleep(1000);
  }
  closeInput();
  for (const Pipe* pipe : {&m_output, &m_error})
    if (pipe->descriptor >= 0) ::close(pipe->descriptor);
}

void ChildProcess::send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t done = 0; done < text.size() && m_input >= 0;) {
    const ssize_t written = ::write(m_input, text.data() + done, text.size() - done); // SIGPIPE is ignored
    if (written > 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      return;
  }
}

void ChildProcess::closeInput() {
  if (m_input >= 0) ::close(m_input);
  m_input = -1;
}

std::vector<std::string> ChildProcess::read(Pipe& pipe) const {
  std::array<char, 4096> bytes{};
  for (std::size_t total = 0; total < (m_end ? kMostAtEnd : kMostBytes);) {
    const ssize_t got = ::read(pipe.descriptor, bytes.data(), bytes.size());
    if (got > 0)
      pipe.rest.append(bytes.data(), static_cast<std::size_t>(got)), total += static_cast<std::size_t>(got);
    else if (got == 0 || errno != EINTR)
      break;
  }
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = pipe.rest.find('\n'); end != std::string::npos; end = pipe.rest.find('\n', begin)) {
    lines.push_back(pipe.rest.substr(begin, end - begin));
    begin = end + 1;
  }
  pipe.rest.erase(0, begin);
  if ((m_end || pipe.rest.size() > kLongestLine) && !pipe.rest.empty()) lines.push_back(std::exchange(pipe.rest, {}));
  return lines;
}

std::optional<ProcessEnd> ChildProcess::end() {
  if (m_end) return m_end;
  int status = 0;
  const pid_t ended = ::waitpid(m_id, &status, WNOHANG);
  if (ended == m_id) {
    ::kill(-m_id, SIGKILL); // what it has started: its group's number is not taken anew while one of them lives
    m_end = WIFSIGNALED(status) ? ProcessEnd{0, WTERMSIG(status)} : ProcessEnd{WEXITSTATUS(status), 0};
  } else if (ended < 0 && errno == ECHILD) { // somebody else has asked for its end
    m_end = ProcessEnd{1, 0};
  }
  return m_end;
}

void ChildProcess::signal(int number) const {
  if (!m_end) ::kill(-m_id, number);
}

std::size_t ChildProcess::residentBytes() const {
  std::ifstream file("/proc/" + std::to_string(m_id) + "/statm");
  std::size_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::optional<std::string> findProgram(const std::string& name) {
  const auto isProgram = [](const std::filesystem::path& file) {
    std::error_code none;
    return std::filesystem::is_regular_file(file, none) && ::access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) return isProgram(name) ? std::optional(name) : std::nullopt;
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name; isProgram(file))
      return file.string();
  return std::nullopt;
}

ProcessOutput runToEnd(const std::vector<std::string>& arguments) {
  ChildProcess process(arguments);
  process.closeInput();
  ProcessOutput output;
  const auto take = [&] {
    for (std::string& line : process.readOutput()) output.lines.push_back(std::move(line));
    for (std::string& line : process.readError()) output.errors.push_back(std::move(line));
  };
  constexpr int kPauseMs = 20; // its end is no event of a pipe
  for (std::optional<ProcessEnd> end; !end;) {
    std::array<pollfd, 2> pipes = {{{process.outputDescriptor(), POLLIN, 0}, {process.errorDescriptor(), POLLIN, 0}}};
    ::poll(pipes.data(), pipes.size(), kPauseMs);
    take();
    end = process.end();
    if (end) output.end = *end;
  }
  for (std::size_t before = SIZE_MAX; before != output.lines.size() + output.errors.size();) {
    before = output.lines.size() + output.errors.size();
    take();
  }
  return output;
}

ProcessEnd runInForeground(const std::vector<std::string>& arguments) {
  const std::string& program = arguments.at(0);
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str())); // NOLINT: as POSIX has it
  words.push_back(nullptr);
  pid_t id = -1;
  std::signal(SIGCHLD, SIG_DFL);
  const int failure = ::posix_spawn(&id, program.c_str(), &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) fail(program, "cannot be started", failure);
  int status = 0;
  while (::waitpid(id, &status, 0) < 0)
    if (errno != EINTR) fail(program, "cannot be waited for", errno);
  return WIFSIGNALED(status) ? ProcessEnd{0, WTERMSIG(status)} : ProcessEnd{WEXITSTATUS(status), 0};
}

bool dieWithParent(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return ::getppid() == parent;
}

std::string ownProgram() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

} // namespace parity::base
