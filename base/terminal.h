// What a stream of this process may be sent besides text: the one place that decides on colours and escapes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace parity::base {

// What decides, as data: of a stream and the environment.
struct TerminalFacts {
  bool isTerminal = false;
  bool isDumb = false;  // TERM=dumb: a terminal that knows no escapes
  bool noColor = false; // NO_COLOR (no-color.org): set to anything but nothing
  bool force = false;   // CLICOLOR_FORCE: set to anything but nothing and 0
  std::size_t columns = 80;
};

// getenv for tests: null where a variable is not set.
using Variable = std::function<const char*(const char* name)>;
TerminalFacts readTerminal(int stream, const Variable& variable);
TerminalFacts readTerminal(int stream); // of the process's own environment

// Whether text may be coloured: on a terminal that is not dumb, or where it is forced; never with NO_COLOR, which goes
// before all else.
bool usesColors(const TerminalFacts& facts);

// Whether a line may be drawn over, as a progress bar is: a terminal that is not dumb. Colours do not matter.
bool canRedraw(const TerminalFacts& facts);

// What takes a line that was drawn back, and puts the next one in its place: an escape, or with NO_COLOR spaces. Empty
// where no line is drawn over.
std::string wipeLine(const TerminalFacts& facts);

} // namespace parity::base
