// Options of every path in one value, and what renderers share.
#include "paths/options.h"

#include <gtest/gtest.h>

#include "paths/store.h"

namespace parity::paths {
namespace {

struct A {
  int number = 7;
};
struct B {
  std::string text = "b";
};

TEST(PathOptions, AreOfEachTypeAndDefaultsWhereNoneIsSet) {
  Options options;
  EXPECT_EQ(std::as_const(options).of<A>().number, 7);
  options.of<A>().number = 8;
  EXPECT_EQ(options.of<B>().text, "b");
  Options copy = options;
  copy.of<A>().number = 9;
  EXPECT_EQ(std::as_const(options).of<A>().number, 8) << "a copy is apart";
  EXPECT_EQ(std::as_const(copy).of<A>().number, 9);
}

TEST(PathOptions, TakeTheRowsOfOnePath) {
  base::KnobTable<A> table;
  table.whole<&A::number>("number", 0, 10, "A number");
  const base::KnobTable<Options> all = knobsOf(table);
  Options options;
  all.apply(options, {{"number", {{"3"}, "--number"}}});
  EXPECT_EQ(options.of<A>().number, 3);
  EXPECT_EQ(all.find("number")->text(options), "3");
}

TEST(Store, MakesEachObjectOnceAndKeepsItsPlace) {
  Store store;
  int made = 0;
  const auto make = [&] { return std::string(1, static_cast<char>('a' + made++)); };
  const std::string* const first = store.get("x", make);
  for (int i = 0; i < 100; ++i) store.get(std::to_string(i), make);
  EXPECT_EQ(store.get("x", make), first);
  EXPECT_EQ(*first, "a");
  EXPECT_EQ(made, 101);
}

} // namespace
} // namespace parity::paths
