// Names for Markdown and Slack: they show as they are, and do nothing.
#include "base/text/markdown.h"

#include <regex>

#include <gtest/gtest.h>

#include "base/text/toml_string.h"

namespace parity::base {
namespace {

const std::string kGap = "\xE2\x80\x8B"; // U+200B

// What a reader sees: references decoded, as the sites do before they look for mentions.
std::string decoded(std::string text) {
  std::smatch found;
  while (std::regex_search(text, found, std::regex("&#(\\d+);")))
    text = found.prefix().str() + static_cast<char>(std::stoi(found[1])) + found.suffix().str();
  return text;
}

TEST(Markdown, PlainTextStaysAsItIs) {
  EXPECT_EQ(markdownText("Rough metal, view front: mean FLIP 0.142 is above 0.100"),
            "Rough metal, view front: mean FLIP 0.142 is above 0.100");
  EXPECT_EQ(slackText("Rough metal 日本語"), "Rough metal 日本語");
}

TEST(Markdown, WhatFormsIsAReference) {
  EXPECT_EQ(markdownText("a|b"), "a&#124;b");
  EXPECT_EQ(markdownText("<b>"), "&#60;b&#62;");
  for (const char c : std::string("\\`*_{}[]<>+!|~\"'"))
    EXPECT_EQ(markdownText(std::string("x") + c).find(c), std::string::npos) << c;
}

TEST(Markdown, NobodyIsCalledAndNothingIsLinked) {
  for (const char* name : {"@all", "a @team/core b", "#12", "!34", "~bug", "%1.0", "$5", "&7", "^alert", "*iteration:1",
                           ":tada:", "https://example.org", "www.example.org", "WWW.example.org", "mail@example.org"}) {
    const std::string shown = decoded(markdownText(name));
    EXPECT_FALSE(std::regex_search(shown, std::regex("[@#!~%$&^*:][^ \xE2]"))) << shown;
    EXPECT_FALSE(std::regex_search(shown, std::regex("www\\.e", std::regex::icase))) << shown;
  }
}

TEST(Markdown, LineStaysALine) {
  EXPECT_EQ(markdownText("a\nb\r\n| c").find_first_of("\r\n"), std::string::npos);
  EXPECT_EQ(slackText("a\nb").find('\n'), std::string::npos);
}

TEST(Slack, ControlSequencesAreText) {
  EXPECT_EQ(slackText("<!channel> & <U1>"), "&lt;!channel&gt; &amp; &lt;U1&gt;");
  EXPECT_EQ(slackText("@here"), "@" + kGap + "here");
  EXPECT_EQ(slackText("*b*"), kGap + "*" + kGap + "b" + kGap + "*" + kGap);
}

TEST(TomlString, EscapesWhatEndsIt) {
  EXPECT_EQ(tomlString("a\"b\\c\n\x7f"), "\"a\\\"b\\\\c\\u000A\\u007F\"");
  EXPECT_EQ(tomlString("\xff"), "\"\xEF\xBF\xBD\"");
}

} // namespace
} // namespace parity::base
