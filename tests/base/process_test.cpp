// Child processes: what they say, how they end, what they hold.
#include "base/process.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include <unistd.h>

#include "base/expect_error.h"

namespace parity::base {
namespace {

std::unique_ptr<ChildProcess> shell(const std::string& script) {
  return std::make_unique<ChildProcess>(std::vector<std::string>{"/bin/sh", "-c", script});
}

// Waits until the condition holds, 20 s at most.
template <typename Condition> bool holdsSoon(const Condition& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

ProcessEnd endOf(ChildProcess& process) {
  std::optional<ProcessEnd> end;
  EXPECT_TRUE(holdsSoon([&] { return (end = process.end()).has_value(); }));
  return end.value_or(ProcessEnd{-1, -1});
}

// Not one that ended and whose parent has not asked for it yet.
bool runs(pid_t id) {
  std::ifstream file("/proc/" + std::to_string(id) + "/stat");
  std::string number, name, state;
  return static_cast<bool>(file >> number >> name >> state) && state != "Z" && state != "X";
}

TEST(ChildProcess, ItsLinesComeWholeAndTheLastOneAtItsEnd) {
  const auto process = shell("read line; echo \"got $line\"; printf 'no end'; echo wrong >&2");
  process->send("this");
  EXPECT_EQ(endOf(*process).exitCode, 0);
  EXPECT_EQ(process->readOutput(), (std::vector<std::string>{"got this", "no end"}));
  EXPECT_EQ(process->readError(), std::vector<std::string>{"wrong"});
}

TEST(ChildProcess, TellsExitCodeAndSignalApart) {
  EXPECT_EQ(endOf(*shell("exit 75")).exitCode, 75);
  const ProcessEnd end = endOf(*shell("kill -SEGV $$"));
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_EQ(end.exitCode, 0);
}

TEST(ChildProcess, MoreThanAPipeHoldsComesThroughAndNothingWaits) {
  const auto process =
      shell("i=0; while [ $i -lt 20000 ]; do echo 0123456789012345678901234567890123456789; i=$((i+1)); done");
  std::size_t lines = 0;
  std::optional<ProcessEnd> end;
  EXPECT_TRUE(holdsSoon([&] {
    end = process->end();
    lines += process->readOutput().size();
    return end.has_value();
  }));
  EXPECT_EQ(lines, 20000u);
}

TEST(ChildProcess, ASignalReachesItsWholeGroup) {
  const auto process = shell("sleep 100 & echo $!; wait");
  std::vector<std::string> lines;
  ASSERT_TRUE(holdsSoon([&] { return !(lines = process->readOutput()).empty(); }));
  const pid_t grandchild = std::stoi(lines.front());
  EXPECT_FALSE(process->end().has_value());
  process->signal(SIGKILL);
  EXPECT_EQ(endOf(*process).signal, SIGKILL);
  EXPECT_TRUE(holdsSoon([&] { return !runs(grandchild); }));
}

TEST(ChildProcess, WhatItLeavesBehindEndsWithIt) {
  // Its number by stderr: "yes" may write to stdout before the shell does.
  const auto process = shell("yes & echo $! >&2; exit 0");
  std::vector<std::string> lines;
  ASSERT_TRUE(holdsSoon([&] { return !(lines = process->readError()).empty(); }));
  EXPECT_EQ(endOf(*process).exitCode, 0);
  process->readOutput(); // comes to an end
  EXPECT_TRUE(holdsSoon([&] { return !runs(std::stoi(lines.front())); }));
}

TEST(ChildProcess, IgnoredSignalsOfTheParentDoNotHideItsEnd) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(endOf(*shell("exit 3")).exitCode, 3);
}

TEST(ChildProcess, IsKilledWithItsObject) {
  pid_t id = 0;
  {
    const auto process = shell("sleep 100");
    id = process->id();
    EXPECT_TRUE(runs(id));
  }
  EXPECT_FALSE(runs(id));
}

TEST(ChildProcess, HasMemory) {
  const auto process = shell("read line");
  EXPECT_TRUE(holdsSoon([&] { return process->residentBytes() > 100'000; }));
  EXPECT_LT(process->residentBytes(), 50'000'000u);
  process->closeInput();
  endOf(*process);
}

TEST(ChildProcess, GetsTheInheritedDescriptorAsNumberThree) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ChildProcess process({"/bin/sh", "-c", "echo there >&3"}, ends[1]);
  EXPECT_EQ(endOf(process).exitCode, 0);
  char text[8] = {};
  EXPECT_EQ(::read(ends[0], text, sizeof text), 6);
  EXPECT_STREQ(text, "there\n");
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(ChildProcess, AProgramThatIsNotThereIsAnError) {
  expectError([] { ChildProcess process({"/nonexistent/program"}); }, "/nonexistent/program", "cannot be started");
}

TEST(ChildProcess, AParentThatIsDeadIsTold) { EXPECT_FALSE(dieWithParent(1 << 30)); }

TEST(RunToEnd, GivesOutputErrorsAndTheExitCode) {
  const auto shell = findProgram("sh");
  ASSERT_TRUE(shell);
  const ProcessOutput output = runToEnd({*shell, "-c", "echo one; echo two >&2; printf three; exit 5"});
  EXPECT_EQ(output.end.exitCode, 5);
  EXPECT_EQ(output.lines, (std::vector<std::string>{"one", "three"}));
  EXPECT_EQ(output.errors, std::vector<std::string>{"two"});
  EXPECT_EQ(runToEnd({*shell, "-c", "kill -KILL $$"}).end.signal, SIGKILL);
  std::size_t bytes = 0;
  for (const std::string& line : runToEnd({*shell, "-c", "seq 200000"}).lines) bytes += line.size() + 1;
  EXPECT_EQ(bytes, 1'288'895u) << "all of a long output";
}

TEST(FindProgram, LooksInPathAndTakesAPathAsItIs) {
  EXPECT_FALSE(findProgram("no program has this name"));
  EXPECT_FALSE(findProgram("/no/program"));
  EXPECT_FALSE(findProgram("/"));
  EXPECT_EQ(findProgram(findProgram("sh").value()), findProgram("sh"));
}

} // namespace
} // namespace parity::base
