// fork and exec with two pipes (or a pseudo-terminal), a deadline, and the child's peak memory.
#include "cli/run_parity.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace parity::tests {
namespace {

// Read end and write end; closed when it goes.
struct Channel {
  int ends[2] = {-1, -1};
  explicit Channel(bool terminal) {
    const bool open =
        terminal ? openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) == 0 : pipe2(ends, O_CLOEXEC) == 0;
    if (!open) throw std::runtime_error("no pipe for the program's output");
  }
  ~Channel() {
    closeEnd(0);
    closeEnd(1);
  }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  void closeEnd(int end) {
    if (ends[end] >= 0) close(ends[end]);
    ends[end] = -1;
  }
};

std::vector<std::string> makeEnvironment(const RunOptions& options) {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos) variables[text.substr(0, equals)] = text.substr(equals + 1);
  }
  const std::string caches = std::string(PARITY_BINARY_DIR) + "/test-caches";
  variables["XDG_CACHE_HOME"] = caches;
  variables["MESA_SHADER_CACHE_DIR"] = caches;
  for (const auto& [name, value] : options.environment) variables[name] = value;
  std::vector<std::string> entries;
  entries.reserve(variables.size());
  for (const auto& [name, value] : variables) entries.push_back(fmt::format("{}={}", name, value));
  return entries;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Appends what can be read now; false at the end of the stream (which a terminal reports as EIO).
bool readSome(int descriptor, std::string& text) {
  char buffer[65536];
  const ssize_t count = read(descriptor, buffer, sizeof(buffer));
  if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

} // namespace

std::filesystem::path parityExecutable() {
  const char* variable = std::getenv("PARITY_EXECUTABLE");
  return variable ? variable : std::string(PARITY_BINARY_DIR) + "/parity";
}

std::vector<std::string> join(std::initializer_list<std::vector<std::string>> lists) {
  std::vector<std::string> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

RunResult runParity(const std::vector<std::string>& arguments, const RunOptions& options) {
  const std::string executable = std::filesystem::absolute(parityExecutable()).string();
  if (access(executable.c_str(), X_OK) != 0) throw std::runtime_error(executable + " is not there: build 'parity'");
  std::vector<std::string> words = join({{executable}, arguments});
  std::vector<std::string> variables = makeEnvironment(options);
  const std::vector<char*> argv = pointersTo(words), envp = pointersTo(variables);

  RunResult result;
  for (const std::string& argument : arguments) result.commandLine += " " + argument;
  Channel in(false), out(false), err(options.terminal);
  if (write(in.ends[1], options.input.data(), options.input.size()) != static_cast<ssize_t>(options.input.size()))
    throw std::runtime_error("the input does not fit into a pipe");
  in.closeEnd(1);
  if (options.closesOutput) out.closeEnd(0);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) { // only calls that are safe between fork and exec
    const bool placed = options.workingFolder.empty() || chdir(options.workingFolder.c_str()) == 0;
    if (placed && dup2(in.ends[0], 0) >= 0 && dup2(out.ends[1], 1) >= 0 && dup2(err.ends[1], 2) >= 0)
      execve(executable.c_str(), argv.data(), envp.data());
    _exit(127);
  }
  out.closeEnd(1);
  err.closeEnd(1);

  bool open[2] = {!options.closesOutput, true};
  int signalsLeft = options.interruptAt.empty() ? 0 : options.signals;
  std::string awaited = options.interruptAt;
  while (open[0] || open[1]) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    const double leftMs = (options.timeoutS - passed.count()) * 1000;
    pollfd polled[2] = {{open[0] ? out.ends[0] : -1, POLLIN, 0}, {open[1] ? err.ends[0] : -1, POLLIN, 0}};
    if (leftMs <= 0 || poll(polled, 2, static_cast<int>(std::max(leftMs, 1.0))) == 0) {
      result.timedOut = true;
      kill(child, SIGKILL);
      break;
    }
    if (polled[0].revents) open[0] = readSome(out.ends[0], result.out);
    if (polled[1].revents) open[1] = readSome(err.ends[0], result.err);
    if (signalsLeft > 0 && result.err.find(awaited) != std::string::npos) {
      --signalsLeft;
      awaited = "interrupted"; // what the program says to the first
      kill(child, options.interruptBy);
    }
  }
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.peakMiB = usage.ru_maxrss / 1024;
  return result;
}

} // namespace parity::tests
