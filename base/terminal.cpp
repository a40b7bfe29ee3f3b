#include "base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace parity::base {

namespace {

// Of a terminal that does not tell its width, or tells nonsense.
constexpr std::size_t kLeastColumns = 40, kMostColumns = 1000, kColumns = 80;

} // namespace

TerminalFacts readTerminal(int stream, const Variable& variable) {
  const auto valueOf = [&](const char* name) {
    const char* value = variable(name);
    return std::string_view(value ? value : "");
  };
  TerminalFacts facts;
  facts.isTerminal = isatty(stream) != 0;
  facts.isDumb = valueOf("TERM") == "dumb";
  facts.noColor = !valueOf("NO_COLOR").empty();
  facts.force = !valueOf("CLICOLOR_FORCE").empty() && valueOf("CLICOLOR_FORCE") != "0";
  winsize size{};
  const bool told = facts.isTerminal && ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  facts.columns = told ? std::clamp<std::size_t>(size.ws_col, kLeastColumns, kMostColumns) : kColumns;
  return facts;
}

TerminalFacts readTerminal(int stream) {
  return readTerminal(stream, [](const char* name) { return std::getenv(name); });
}

bool usesColors(const TerminalFacts& facts) {
  return !facts.noColor && (facts.force || (facts.isTerminal && !facts.isDumb));
}

bool canRedraw(const TerminalFacts& facts) { return facts.isTerminal && !facts.isDumb; }

std::string wipeLine(const TerminalFacts& facts) {
  if (!canRedraw(facts)) return {};
  return facts.noColor ? "\r" + std::string(facts.columns - 1, ' ') + "\r" : "\r\x1b[K";
}

} // namespace parity::base
