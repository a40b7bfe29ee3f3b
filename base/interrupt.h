// What a run says, and does, when it is interrupted.
#pragma once

#include <string>

namespace parity::base {

// From the first call on SIGINT and SIGTERM write "error: " and this line to stderr and then end the process as ever,
// by the signal; one that is ignored (of a job in the background) stays so. Each call takes the place of the one
// before. Any thread may call it.
void setInterruptNote(const std::string& line);

// While one lives, the first SIGINT, SIGTERM or SIGHUP does not end the process: the program asks for it, and ends in
// good order. A second signal ends the process at once, as if nobody listened. One that is ignored stays so. There is
// one at a time.
class StopSignal {
public:
  explicit StopSignal(const std::string& note = {}); // a line to stderr at the first signal; empty: none
  ~StopSignal();                                     // signals do again what they did before
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  static int received(); // the number of the signal; 0: none since the last one was made
};

// "SIGINT"; "signal 99" for one without a name.
std::string signalName(int number);

} // namespace parity::base
