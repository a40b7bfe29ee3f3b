// Hostile text, destination by destination: terminals and logs, JSON that is printed, CSV.
#include "base/text/shown_text.h"

#include <gtest/gtest.h>

namespace parity::base {
namespace {

TEST(ShownText, ControlsAndWhatReordersTextAreReplaced) {
  EXPECT_EQ(plainLine("a\x1b[31mb\x07\x7f"), "a\uFFFD[31mb\uFFFD\uFFFD");
  EXPECT_EQ(plainLine("\xC2\x9B"
                      "31m \u202Etxt.exe\u2066 \u2028"),
            "\uFFFD31m \uFFFDtxt.exe\uFFFD \uFFFD")
      << "C1 controls and bidirectional overrides";
  EXPECT_EQ(plainLine("\x9b\xff"), "\uFFFD\uFFFD") << "no UTF-8";
  EXPECT_EQ(plainLine("Größe 木 #1 ## [x]"), "Größe 木 #1 ## [x]");
}

TEST(ShownText, CommandsOfLogsAreNone) {
  EXPECT_EQ(plainLine("a ##[error]b ##vso[task.complete] ###[x]"),
            "a #\uFFFD[error]b #\uFFFDvso[task.complete] ##\uFFFD[x]");
  EXPECT_EQ(shownText("::stop-commands::tok\n  \t\u00A0::error::x\nmean ::x\n"),
            ":\uFFFDstop-commands::tok\n  \t\u00A0:\uFFFD"
            "error::x\nmean ::x\n");
  EXPECT_EQ(shownText("a\r\n::b"), "a\r\n:\uFFFD"
                                   "b");
  EXPECT_EQ(shownText("a\r::b\r\r\n\r"), "a\uFFFD::b\uFFFD\r\n\uFFFD");
  EXPECT_EQ(shownText(""), "");
}

TEST(ShownText, OnlyOurOwnColoursStay) {
  EXPECT_EQ(shownText("\x1b[1;31mfail\x1b[0m \x1b[2J", Colors::ours), "\x1b[1;31mfail\x1b[0m \uFFFD[2J");
  EXPECT_EQ(shownText("\x1b[31mfail"), "\uFFFD[31mfail");
}

TEST(ShownText, StringsOfJsonKeepTheirValue) {
  EXPECT_EQ(shownStrings("{\n  \"a\": \"\u202E\xC2\x85##[x]##vso[\"\n}"),
            "{\n  \"a\": \"\\u202e\\u0085#\\u0023[x]#\\u0023vso[\"\n}");
}

TEST(ShownText, CellsAreNoFormulasAndNumbersStayNumbers) {
  for (const char* formula : {"=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "  =A1",
                              "\uFF1D"
                              "A1"})
    EXPECT_EQ(csvCell(formula), "'" + std::string(formula)) << formula;
  EXPECT_EQ(csvCell("=HYPERLINK(\"x\",\"y\")"), "\"'=HYPERLINK(\"\"x\"\",\"\"y\"\")\"");
  for (const char* number : {"-1.5", "+3", "1e-3", "-inf", "-7", ""}) EXPECT_EQ(csvCell(number), number);
  EXPECT_EQ(csvCell("a,b"), "\"a,b\"");
  EXPECT_EQ(csvCell("a\nb"), "a\uFFFDb");
  EXPECT_EQ(csvCell("::stop-commands::tok"), "\"::stop-commands::tok\"") << "no command of a log";
}

} // namespace
} // namespace parity::base
