// Runs the real program as a user does, and catches all that comes out of it.
#pragma once

#include <csignal>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace parity::tests {

struct RunOptions {
  std::vector<std::pair<std::string, std::string>> environment; // added to, or in place of, the test's own
  std::filesystem::path workingFolder;                          // empty: the test's own
  std::string input;                                            // on stdin; at most what a pipe holds
  bool closesOutput = false;                                    // stdout has no reader, as after `| head -0`
  bool terminal = false;   // stderr is a terminal (a pseudo-terminal), as for a user who sends stdout to a file
  std::string interruptAt; // the signal is sent, once, when stderr holds this; empty: never
  int interruptBy = SIGINT;
  int signals = 1; // so many of them, the others as soon as the first was answered on stderr
  double timeoutS = 120;
};

struct RunResult {
  int exitCode = -1; // -1: it did not exit by itself
  int signal = 0;    // that ended it
  bool timedOut = false;
  long peakMiB = 0; // of resident memory
  std::string commandLine, out, err;
};

// PARITY_BINARY_DIR/parity, or what the environment variable PARITY_EXECUTABLE names.
std::filesystem::path parityExecutable();

// Runs it with these arguments, without a shell. Its caches lie in the build folder, shared by all tests: the driver
// compiles a shader once. A run past the timeout is killed. Throws std::runtime_error where it cannot be started.
RunResult runParity(const std::vector<std::string>& arguments, const RunOptions& options = {});

// All lists, one behind the other.
std::vector<std::string> join(std::initializer_list<std::vector<std::string>> lists);

} // namespace parity::tests
