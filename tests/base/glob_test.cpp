// Globs: which names a pattern takes, and that no pattern takes long.
#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "base/text/glob.h"

namespace parity::base {
namespace {

TEST(Glob, TextMatchesItselfAndOnlyAsAWhole) {
  EXPECT_TRUE(matchesGlob("", ""));
  EXPECT_TRUE(matchesGlob("Glass", "Glass"));
  EXPECT_FALSE(matchesGlob("Glass", "glass"));
  EXPECT_FALSE(matchesGlob("Glass", "Glass 2"));
  EXPECT_FALSE(matchesGlob("Glass", "A Glass"));
  EXPECT_FALSE(matchesGlob("", "x"));
  EXPECT_FALSE(matchesGlob("x", ""));
}

TEST(Glob, StarTakesAnyRunAlsoNone) {
  for (const char* text : {"", "a", "a/b.c", "\n"}) EXPECT_TRUE(matchesGlob("*", text)) << text;
  EXPECT_TRUE(matchesGlob("a*c", "ac"));
  EXPECT_TRUE(matchesGlob("a*c", "abcbc"));
  EXPECT_FALSE(matchesGlob("a*c", "abcb"));
  EXPECT_TRUE(matchesGlob("*metal*", "Rough metal 3"));
  EXPECT_TRUE(matchesGlob("**", ""));
  EXPECT_TRUE(matchesGlob("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(matchesGlob("a*b*c", "a-c-b"));
}

TEST(Glob, QuestionMarkTakesOneCharacter) {
  EXPECT_TRUE(matchesGlob("m?", "m1"));
  EXPECT_FALSE(matchesGlob("m?", "m"));
  EXPECT_FALSE(matchesGlob("m?", "m12"));
  EXPECT_TRUE(matchesGlob("?", "é")); // two bytes, one character
  EXPECT_TRUE(matchesGlob("?", "日"));
  EXPECT_TRUE(matchesGlob("?", "\xF0\x9F\x98\x80"));
}

TEST(Glob, SetsTakeOneOfTheirCharacters) {
  EXPECT_TRUE(matchesGlob("[Mm]etal", "metal"));
  EXPECT_FALSE(matchesGlob("[Mm]etal", "Petal"));
  EXPECT_TRUE(matchesGlob("[!Mm]etal", "Petal"));
  EXPECT_FALSE(matchesGlob("[!Mm]etal", "metal"));
  EXPECT_FALSE(matchesGlob("[!Mm]etal", "etal"));
  EXPECT_TRUE(matchesGlob("lod[0-3]", "lod2"));
  EXPECT_FALSE(matchesGlob("lod[0-3]", "lod4"));
  EXPECT_TRUE(matchesGlob("[à-ü]", "é"));
  EXPECT_FALSE(matchesGlob("[é]", "\xC3")); // half a character is not the character
}

TEST(Glob, SpecialCharactersStandForThemselvesWhereNothingElseMakesSense) {
  EXPECT_TRUE(matchesGlob("[*]", "*"));
  EXPECT_FALSE(matchesGlob("[*]", "x"));
  EXPECT_TRUE(matchesGlob("[]]", "]"));
  EXPECT_TRUE(matchesGlob("[!]]", "x"));
  EXPECT_FALSE(matchesGlob("[!]]", "]"));
  EXPECT_TRUE(matchesGlob("[a-]", "-"));
  EXPECT_TRUE(matchesGlob("[-a]", "-"));
  EXPECT_FALSE(matchesGlob("[a-]", "b"));
  EXPECT_TRUE(matchesGlob("a[b", "a[b"));
  EXPECT_TRUE(matchesGlob("[", "["));
  EXPECT_TRUE(matchesGlob("[]", "[]"));
}

TEST(Glob, InvalidUtf8IsMatchedByteByByte) {
  EXPECT_TRUE(matchesGlob("a?b", "a\xFF"
                                 "b"));
  EXPECT_TRUE(matchesGlob("a\xFF*", "a\xFF\xFE"));
  EXPECT_FALSE(matchesGlob("\xFF", "\xFE"));
  EXPECT_TRUE(matchesGlob("*", "\xE6\x97")); // a cut-off character
}

// Backtracking into every star would take 2^28 steps and more; one remembered star takes |glob| x |text|.
TEST(Glob, AnExactOneMatchesItsNameAlone) {
  for (const std::string name : {"plain", "a [x]", "a*b?", "[!a]", "\xc3\xa9*"}) {
    EXPECT_TRUE(matchesGlob(exactGlob(name), name)) << name;
    EXPECT_FALSE(matchesGlob(exactGlob(name), name + "x")) << name;
  }
  EXPECT_FALSE(matchesGlob(exactGlob("a [x]"), "a (x)"));
  EXPECT_FALSE(matchesGlob(exactGlob("a*"), "ab"));
  EXPECT_TRUE(matchesGlob(exactGlob("a\xef\xbf\xbd"), "a\xff")) << "a byte that a report could not show";
}

TEST(Glob, ManyStarsDoNotTakeExponentialTime) {
  std::string glob;
  for (int i = 0; i < 30; ++i) glob += "a*";
  glob += "b";
  const std::string text(5000, 'a');
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(matchesGlob(glob, text));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

} // namespace
} // namespace parity::base
