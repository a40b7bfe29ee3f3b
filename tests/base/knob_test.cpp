// Values of knobs from text, and tables of them.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/knob/table.h"
#include "base/member_count.h"

namespace parity::base {
namespace {

enum class Kind { soft, hard };
struct Inner {
  float weight = 0.1f;
  int count = 3;
};
struct Options {
  std::string preset = "plain";
  Kind kind = Kind::soft;
  bool on = false;
  Inner inner;
  std::string name;
  std::vector<std::string> globs;
};
static_assert(memberCount<Inner>() == 2 && memberCount<Options>() == 6);
struct Odd {
  std::optional<Inner> inner;
  std::vector<Inner> list;
  std::optional<std::string> text;
};
static_assert(memberCount<Odd>() == 3);

KnobTable<Options> makeTable() {
  KnobTable<Options> t;
  t.section("Group");
  t.special(
       KnobType::choice, "preset", "", "Sets the others",
       [](Options& o, const std::string& text) {
         o = {};
         o.preset = text;
         o.inner.count = 7;
       },
       [](const Options& o) { return o.preset; })
      .alias("old-preset");
  t.choice<&Options::kind>("kind", {"soft", "hard"}, "A kind");
  t.flag<&Options::on>("on", "A flag");
  t.number<&Options::inner, &Inner::weight>("weight", 0, 1, "A weight");
  t.whole<&Options::inner, &Inner::count>("count", 0, 10, "A count");
  t.text<&Options::name>("name", "none", "A name");
  t.texts<&Options::globs>("globs", "all", "Globs");
  return t;
}

GivenKnobs given(const std::string& id, const KnobValue& value) { return {{id, {value, "--" + id}}}; }

std::string reasonOf(const std::string& id, const std::string& text) {
  Options options;
  try {
    makeTable().apply(options, given(id, {text}));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(error.subject(), "--" + id);
    return error.reason();
  }
  return {};
}

TEST(Knob, AValueIsReadIntoItsMember) {
  Options o;
  makeTable().apply(o, {{"kind", {{"hard"}, ""}},
                        {"on", {{"on"}, ""}},
                        {"weight", {{"0.30000001"}, ""}},
                        {"count", {{"4"}, ""}},
                        {"name", {{"x"}, ""}},
                        {"globs", {{"a", "b, c"}, ""}}});
  EXPECT_EQ(o.kind, Kind::hard);
  EXPECT_TRUE(o.on);
  EXPECT_EQ(o.inner.weight, 0.3f);
  EXPECT_EQ(o.inner.count, 4);
  EXPECT_EQ(o.name, "x");
  EXPECT_EQ(o.globs, (std::vector<std::string>{"a", "b, c"}));
}

TEST(Knob, APresetGoesBeforeWhatItSets) {
  Options o;
  makeTable().apply(o, merged(given("count", {"2"}), given("preset", {"other"})));
  EXPECT_EQ(o.preset, "other");
  EXPECT_EQ(o.inner.count, 2) << "in the order of the table, not of the ids";
}

TEST(Knob, TheStrongerOfTwoHolds) {
  EXPECT_EQ(merged(given("count", {"1"}), given("count", {"2"})).at("count").value, KnobValue{"2"});
  EXPECT_EQ(merged(given("count", {"1"}), given("on", {"on"})).size(), 2u);
}

TEST(Knob, WhatIsRefusedSaysWhatIsWanted) {
  EXPECT_EQ(reasonOf("kind", "sofd"), "'sofd' is unknown; did you mean 'soft'? (soft, hard)");
  EXPECT_EQ(reasonOf("on", "yes"), "'yes' is not on or off");
  for (const char* text : {"1.5", "-0.1", "nan", "inf", "", "0.5x", " 0.5", "x"})
    EXPECT_EQ(reasonOf("weight", text), std::string("'") + text + "' is not a number from 0 to 1");
  for (const char* text : {"1.5", "11", "-1", "1e99"})
    EXPECT_EQ(reasonOf("count", text), std::string("'") + text + "' is not a whole number from 0 to 10");
  EXPECT_EQ(reasonOf("count", "1e1"), "");
}

TEST(Knob, ATextIsNeverOneOfTheProgramsWords) {
  const KnobTable<Options> table = makeTable();
  const auto textOf = [&](const Options& o, const char* id) { return table.find(id)->text(o); };
  Options plain, named;
  named.name = "none";
  named.globs = {"all"};
  EXPECT_EQ(textOf(plain, "name"), "none");
  EXPECT_EQ(textOf(named, "name"), "'none'");
  EXPECT_EQ(textOf(plain, "globs"), "all");
  EXPECT_EQ(textOf(named, "globs"), "'all'");
  EXPECT_EQ(listText({"a", "b"}, ""), "'a', 'b'");
  EXPECT_EQ(listText({"a', 'b"}, ""), "'a\\', \\'b'");
}

TEST(Knob, NumbersReadBackAsTheVerySame) {
  for (const float value : {0.1f, 1e-30f, 16777216.f, 0.30000001f})
    EXPECT_EQ(readNumbers(numberText(value), "A").at(0), value);
  EXPECT_EQ(readNumbers("1,-2.5,3e2", "A,B,C"), (std::vector<float>{1, -2.5f, 300}));
  for (const char* text : {"1,2", "1,2,3,4", "1,,3", "1,2,", ",1,2", "1,2,nan", "1,2,1e39", "a,b,c", ""})
    EXPECT_THROW(readNumbers(text, "A,B,C"), KnobError) << text;
}

TEST(Knob, SharesAndBytes) {
  EXPECT_EQ(readShare("0.5%"), 0.005);
  EXPECT_EQ(readShare("1"), 1);
  for (const char* text : {"0", "101%", "-1%", "%", "nan", "0.5%%", ""})
    EXPECT_THROW(readShare(text), KnobError) << text;
  EXPECT_EQ(readBytes("500M"), std::size_t{500} << 20);
  EXPECT_EQ(readBytes("4g"), std::size_t{4} << 30);
  EXPECT_EQ(readBytes("17"), 17u);
  for (const char* text : {"0", "M", "-1", "1.5G", "99999999999T", "1GB", ""})
    EXPECT_THROW(readBytes(text), KnobError) << text;
  EXPECT_EQ(readSeconds("300"), 300);
  EXPECT_EQ(readSeconds("0.5s"), 0.5);
  EXPECT_EQ(readSeconds("5m"), 300);
  EXPECT_EQ(readSeconds("2h"), 7200);
  for (const char* text : {"0", "-1s", "m", "5 m", "1d", "nan", "inf", ""})
    EXPECT_THROW(readSeconds(text), KnobError) << text;
}

TEST(Knob, AKnobIsFoundByAnOlderName) {
  const KnobTable<Options> table = makeTable();
  EXPECT_EQ(table.find("old-preset"), table.find("preset"));
  EXPECT_EQ(table.find("nothing"), nullptr);
  EXPECT_EQ(keyOf("sky-light-color"), "sky_light_color");
}

} // namespace
} // namespace parity::base
