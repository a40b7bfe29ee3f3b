// Which streams are coloured and drawn over, by what the environment says.
#include <map>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/terminal.h"

namespace parity::base {
namespace {

TerminalFacts factsOf(bool isTerminal, const std::map<std::string, std::string>& variables) {
  TerminalFacts facts = readTerminal(-1, [&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
  EXPECT_FALSE(facts.isTerminal) << "-1 is no stream";
  facts.isTerminal = isTerminal;
  return facts;
}

TEST(Terminal, ColoursAreForTerminalsUnlessTheEnvironmentSaysOtherwise) {
  EXPECT_TRUE(usesColors(factsOf(true, {{"TERM", "xterm"}})));
  EXPECT_TRUE(usesColors(factsOf(true, {}))) << "TERM is not set: as a terminal of CI";
  EXPECT_FALSE(usesColors(factsOf(false, {{"TERM", "xterm"}})));
  EXPECT_FALSE(usesColors(factsOf(true, {{"TERM", "dumb"}})));
  EXPECT_FALSE(usesColors(factsOf(true, {{"NO_COLOR", "1"}})));
  EXPECT_TRUE(usesColors(factsOf(true, {{"NO_COLOR", ""}}))) << "an empty one does not count";
  EXPECT_TRUE(usesColors(factsOf(false, {{"CLICOLOR_FORCE", "1"}})));
  EXPECT_TRUE(usesColors(factsOf(true, {{"CLICOLOR_FORCE", "1"}, {"TERM", "dumb"}})));
  EXPECT_FALSE(usesColors(factsOf(false, {{"CLICOLOR_FORCE", "0"}})));
  EXPECT_FALSE(usesColors(factsOf(false, {{"CLICOLOR_FORCE", ""}})));
  EXPECT_FALSE(usesColors(factsOf(true, {{"CLICOLOR_FORCE", "1"}, {"NO_COLOR", "1"}}))) << "NO_COLOR goes first";
}

TEST(Terminal, LinesAreDrawnOverOnTerminalsThatAreNotDumbAndWithoutEscapesWhereNoColourIsWanted) {
  EXPECT_EQ(wipeLine(factsOf(true, {})), "\r\x1b[K");
  EXPECT_EQ(wipeLine(factsOf(false, {})), "");
  EXPECT_EQ(wipeLine(factsOf(false, {{"CLICOLOR_FORCE", "1"}})), "") << "a file is never drawn over";
  EXPECT_EQ(wipeLine(factsOf(true, {{"TERM", "dumb"}})), "");
  TerminalFacts plain = factsOf(true, {{"NO_COLOR", "1"}});
  plain.columns = 5;
  EXPECT_EQ(wipeLine(plain), "\r    \r");
}

} // namespace
} // namespace parity::base
