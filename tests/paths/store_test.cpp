// What renderers share is made once, at once or in the background.
#include "paths/store.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace parity::paths {
namespace {

TEST(Store, MakesAnObjectOnce) {
  Store store;
  int made = 0;
  const auto make = [&] { return ++made; };
  int* const object = store.get("a", make);
  EXPECT_EQ(*object, 1);
  EXPECT_EQ(store.get("a", make), object);
  EXPECT_EQ(*store.get("b", make), 2);
}

TEST(Store, GivesWhatWasBegun) {
  Store store;
  store.begin("a", [] { return 7; });
  store.begin("a", [] { return 8; });
  int* const object = store.get("a", [] { return 9; });
  EXPECT_EQ(*object, 7);
  *object = 10;
  EXPECT_EQ(store.get("a", [] { return 9; }), object);
  store.begin("a", [] { return 11; });
  EXPECT_EQ(*store.get("a", [] { return 9; }), 10);
}

TEST(Store, ThrowsWhereWhatWasBegunIsTaken) {
  Store store;
  const auto fail = []() -> int { throw std::runtime_error("no"); };
  store.begin("a", fail);
  EXPECT_THROW(store.get("a", [] { return 1; }), std::runtime_error);
  EXPECT_THROW(store.get("b", fail), std::runtime_error);
  EXPECT_EQ(*store.get("b", [] { return 1; }), 1) << "nothing was kept of the failure";
}

} // namespace
} // namespace parity::paths
