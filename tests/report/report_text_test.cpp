// Untrusted text: what becomes of each kind of byte.
#include <gtest/gtest.h>

#include "base/text/text.h"

namespace parity::report {
namespace {

TEST(CleanUtf8, ValidTextIsKept) {
  for (const char* text : {"", "plain", "é 日本語 \U0001F600", "\u0080\u07FF\u0800\uFFFF\U00010000\U0010FFFF"})
    EXPECT_EQ(base::cleanUtf8(text), text);
}

// The Unicode Standard, chapter 3, table 3-7: well-formed byte sequences.
TEST(CleanUtf8, IllFormedBytesAreReplacedOneByOne) {
  EXPECT_EQ(base::cleanUtf8("a\x80z"), "a\uFFFDz");                 // a lone continuation
  EXPECT_EQ(base::cleanUtf8("\xC0\xAF"), "\uFFFD\uFFFD");           // overlong '/'
  EXPECT_EQ(base::cleanUtf8("\xE0\x9F\xBF"), "\uFFFD\uFFFD\uFFFD"); // overlong
  EXPECT_EQ(base::cleanUtf8("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD"); // a surrogate
  EXPECT_EQ(base::cleanUtf8("\xF0\x8F\xBF\xBF"), "\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(base::cleanUtf8("\xF4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD"); // above U+10FFFF
  EXPECT_EQ(base::cleanUtf8("\xF5\x80"), "\uFFFD\uFFFD");
  EXPECT_EQ(base::cleanUtf8("\xE6\x97"), "\uFFFD\uFFFD"); // cut off
  EXPECT_EQ(base::cleanUtf8("\xE6\x97z"), "\uFFFD\uFFFDz");
}

TEST(EscapeMarkup, LeavesNothingThatMarkupCouldUse) {
  EXPECT_EQ(base::escapeMarkup("<a href=\"x\">'&amp;'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(base::escapeMarkup("]]>"), "]]&gt;");
  EXPECT_EQ(base::escapeMarkup("a\nb\tc\rd"), "a&#10;b&#9;c&#13;d");
  EXPECT_EQ(base::escapeMarkup(std::string_view("\0\x01\x1F", 3)), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(base::escapeMarkup("\uFFFE\uFFFF"), "\uFFFD\uFFFD");
  EXPECT_EQ(base::escapeMarkup("日本語"), "日本語");
}

TEST(PlainLine, HoldsNoControlCharacters) {
  EXPECT_EQ(base::plainLine("a\x1b[31mb\nc\x7f"), "a\uFFFD[31mb\uFFFDc\uFFFD");
  EXPECT_EQ(base::plainLine("\u0085\u009B"), "\uFFFD\uFFFD");   // C1: next line, CSI
  EXPECT_EQ(base::plainLine("\u202Ex\u2066"), "\uFFFDx\uFFFD"); // bidirectional override, isolate
  EXPECT_EQ(base::plainLine("é 日本語"), "é 日本語");
}

TEST(DisplayWidth, KnownWidths) {
  EXPECT_EQ(base::displayWidth(""), 0u);
  EXPECT_EQ(base::displayWidth("abc"), 3u);
  EXPECT_EQ(base::displayWidth("é"), 1u);
  EXPECT_EQ(base::displayWidth("e\u0301"), 1u); // combining acute
  EXPECT_EQ(base::displayWidth("日本語"), 6u);
  EXPECT_EQ(base::displayWidth("\U0001F600"), 2u);
}

TEST(FitColumns, PadsAndCutsToExactlyTheColumnsAsked) {
  EXPECT_EQ(base::fitColumns("ab", 4), "ab  ");
  EXPECT_EQ(base::fitColumns("abcd", 4), "abcd");
  EXPECT_EQ(base::fitColumns("abcde", 4), "abc…");
  EXPECT_EQ(base::fitColumns("日本語", 4), "日… "); // half of a wide character does not fit
  for (std::size_t columns = 1; columns < 9; ++columns)
    EXPECT_EQ(base::displayWidth(base::fitColumns("x日本e\u0301語y", columns)), columns);
}

} // namespace
} // namespace parity::report
