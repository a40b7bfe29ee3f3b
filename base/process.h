// A child process with pipes, and what it takes of the machine. Linux.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace parity::base {

// How a process ended.
struct ProcessEnd {
  int exitCode = 0, signal = 0; // signal: 0 where it ended by itself
};

// A process of its own group: what it starts ends with it. Not copyable; the destructor kills what still runs, and
// waits two seconds at most for its end.
class ChildProcess {
public:
  // arguments: the program's path, then its arguments. inherited: a descriptor that it gets as number 3; -1: none.
  // Throws Error (exit 4) where it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& arguments, int inherited = -1);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return m_id; }
  // To its standard input; without effect where it no longer reads.
  void send(const std::string& line);
  void closeInput();
  // Whole lines that it has written since the last call, without their ends; never waits. A call takes some 64 KiB,
  // after its end all that is left, also what lacks a line feed.
  std::vector<std::string> readOutput() { return read(m_output); }
  std::vector<std::string> readError() { return read(m_error); }
  // Descriptors to wait for with poll().
  int outputDescriptor() const { return m_output.descriptor; }
  int errorDescriptor() const { return m_error.descriptor; }
  // Nothing while it runs; never waits.
  std::optional<ProcessEnd> end();
  // Sends a signal to its group.
  void signal(int number) const;
  // Memory that it holds at the moment, bytes; 0 where nobody knows.
  std::size_t residentBytes() const;

private:
  struct Pipe {
    int descriptor = -1;
    std::string rest; // of a line
  };
  std::vector<std::string> read(Pipe& pipe) const;

  pid_t m_id = -1;
  int m_input = -1;
  Pipe m_output, m_error;
  std::optional<ProcessEnd> m_end;
};

// The program of that name in the folders of PATH, or as it is where it has a '/'; nothing where there is none.
std::optional<std::string> findProgram(const std::string& name);

struct ProcessOutput {
  ProcessEnd end;
  std::vector<std::string> lines, errors; // of stdout and of stderr
};
// Runs it to its end, without input. arguments: as of ChildProcess. Throws Error (exit 4) where it cannot be started.
ProcessOutput runToEnd(const std::vector<std::string>& arguments);

// Runs it in the foreground: it has this process's stdin and stderr, and writes to stderr what it writes to stdout.
// Throws Error (exit 4) where it cannot be started.
ProcessEnd runInForeground(const std::vector<std::string>& arguments);

// In a child: it is killed when the process that started it dies. Returns false where that is dead already.
bool dieWithParent(pid_t parent);

// The path of the program that runs.
std::string ownProgram();

} // namespace parity::base
