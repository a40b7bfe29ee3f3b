// Words come out of a shell as they went in.
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/text/shell_word.h"

namespace parity::base {
namespace {

TEST(ShellWord, IsQuotedOnlyWhereItHasToBe) {
  EXPECT_EQ(shellWord("a/b-c_1.glb"), "a/b-c_1.glb");
  EXPECT_EQ(shellWord("30,50,4"), "30,50,4");
  EXPECT_EQ(shellWord(""), "''");
  EXPECT_EQ(shellWord("it's"), R"('it'\''s')");
}

TEST(ShellWord, AShellReadsItBack) {
  for (const std::string word :
       {"two words", "it's", "\"$(echo x)\"", "`id`", "a\\b", "*", "~", "a\nb", "!x", "#", "ü&;|<>"}) {
    const std::string command = "printf '%s.' " + shellWord(word);
    FILE* pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string out;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
    EXPECT_EQ(pclose(pipe), 0);
    EXPECT_EQ(out, word + ".") << command;
  }
}

} // namespace
} // namespace parity::base
