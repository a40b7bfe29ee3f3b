// Wrapped text fits its columns and loses nothing; a wrapped command is the same command.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/lines_of.h"
#include "base/text/text.h"
#include "base/text/wrap.h"

namespace parity::base {
namespace {

std::string withoutSpaces(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

TEST(Wrap, BreaksAtSpacesAndIndentsTheOtherLines) {
  EXPECT_EQ(wrapText("mean FLIP is above its limit", 14, 4, 2), "mean FLIP\n  is above its\n  limit");
  EXPECT_EQ(wrapText("mean FLIP", 9, 0, 2), "mean FLIP");
  EXPECT_EQ(wrapText("mean FLIP", 8, 0, 2), "mean\n  FLIP");
}

TEST(Wrap, LeavesTextAsItIsWithoutColumns) {
  const std::string line(500, 'x');
  EXPECT_EQ(wrapText(line + "  y", 0, 20, 4), line + "  y");
  EXPECT_EQ(wrapCommand("parity diff " + line, 0, 2), "  parity diff " + line);
}

TEST(Wrap, NoLineIsWiderThanItsColumnsWhateverTheWordsAre) {
  const std::string text =
      "a " + std::string(90, 'y') + " 日本語のとても長い名前はここにあります b é́ " + std::string(33, 'z');
  for (std::size_t columns = 20; columns < 60; ++columns) {
    const std::string wrapped = wrapText(text, columns, 7, 4);
    const auto lines = tests::linesOf(wrapped);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_LE(displayWidth(lines[i]) + (i == 0 ? 7 : 0), columns) << wrapped;
      EXPECT_TRUE(i == 0 || lines[i].starts_with("    ")) << wrapped;
    }
    EXPECT_EQ(withoutSpaces(wrapped), withoutSpaces(text));
  }
}

TEST(Wrap, ACommandIsBrokenOutsideOfQuotesAndStaysTheSame) {
  const std::string command =
      R"(parity diff --suite 'my suite.toml' --only 'Lamp post/front view' --material 'it'\''s gold')";
  for (std::size_t columns = 24; columns < 100; ++columns) {
    const std::string wrapped = wrapCommand(command, columns, 2);
    const auto lines = tests::linesOf(wrapped);
    std::string joined;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_LE(displayWidth(lines[i]), std::max<std::size_t>(columns, 33)) << "but for a word that is longer";
      EXPECT_EQ(lines[i].ends_with(" \\"), i + 1 < lines.size()) << wrapped;
      const std::size_t begin = lines[i].find_first_not_of(' ');
      joined += (i == 0 ? "" : " ") + lines[i].substr(begin, lines[i].size() - begin - (i + 1 < lines.size() ? 2 : 0));
    }
    EXPECT_EQ(joined, command);
  }
}

} // namespace
} // namespace parity::base
