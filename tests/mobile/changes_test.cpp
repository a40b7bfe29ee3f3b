// What explain tries of the mobile path.
#include <set>

#include <gtest/gtest.h>

#include "mobile/options.h"
#include "mobile/path.h"

namespace parity::mobile {
namespace {

using Change = paths::Path::Change;

TEST(Changes, SetKnobsOfThePathToWhatTheySay) {
  std::set<std::string> ids;
  for (const Change& change : path().changes()) {
    EXPECT_TRUE(ids.insert(change.name + "=" + change.value).second) << change.name;
    EXPECT_FALSE(change.values.empty()) << change.name;
    for (const auto& [id, value] : change.values) {
      const auto* row = path().knobs().find(id);
      ASSERT_NE(row, nullptr) << id;
      paths::Options options;
      row->set(options, {value});
      EXPECT_EQ(row->text(options), value) << id;
    }
  }
  for (const char* id : {"mobile-light-cap=off", "mobile-pixel-fog=on", "mobile-lightmap=hq"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

TEST(Changes, TakeAnApproximationBackOrCheapen) {
  std::set<std::string> approximations;
  for (const Change& change : path().changes()) {
    EXPECT_EQ(change.approximation.empty(), change.cheapens) << change.name;
    if (!change.cheapens && change.name != "formulas") {
      EXPECT_TRUE(approximations.insert(change.approximation).second) << change.approximation;
    }
  }
}

} // namespace
} // namespace parity::mobile
