// Which scenes are compared anew, and what is told of one that comes out otherwise.
#include "job/sentinels.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/expect_error.h"

namespace parity::job {
namespace {

std::vector<SceneRequest> makeScenes(std::size_t count) {
  std::vector<SceneRequest> scenes(count);
  for (std::size_t i = 0; i < count; ++i) scenes[i].name = "scene " + std::to_string(i);
  return scenes;
}

TEST(Sentinels, AreEightOrAHundredthAndTheSameOnADate) {
  EXPECT_EQ(chooseSentinels(makeScenes(3), "2026-11-25").size(), 3u);
  EXPECT_EQ(chooseSentinels(makeScenes(640), "2026-11-25").size(), 8u);
  EXPECT_EQ(chooseSentinels(makeScenes(2500), "2026-11-25").size(), 25u);
  EXPECT_EQ(chooseSentinels(makeScenes(640), "2026-11-25"), chooseSentinels(makeScenes(640), "2026-11-25"));
  EXPECT_NE(chooseSentinels(makeScenes(640), "2026-11-25"), chooseSentinels(makeScenes(640), "2026-11-26"));
}

// A scene whose result is wrong is caught by p = 1 - (1 - 8/640)^100 = .716 in 100 nights.
TEST(Sentinels, ComeToMostScenesIn100Days) {
  std::set<std::size_t> seen;
  for (int day = 0; day < 100; ++day)
    for (const std::size_t place : chooseSentinels(makeScenes(640), "day " + std::to_string(day))) seen.insert(place);
  EXPECT_NEAR(static_cast<double>(seen.size()) / 640, 0.716, 0.06);
}

TEST(Sentinels, ADifferenceIsNamed) {
  SceneRecord cached, now;
  cached.result.name = now.result.name = "Hero";
  cached.pictures = {{"images/a.png", {std::byte{1}}}, {"images/b.png", {std::byte{2}}}};
  now.pictures = {cached.pictures[1], cached.pictures[0]}; // in another order
  EXPECT_NO_THROW(requireSame(cached, now));
  now.pictures[0].bytes[0] ^= std::byte{1};
  base::expectError([&] { requireSame(cached, now); }, "sentinel", "images/b.png differs");
  now = cached;
  now.result.views.emplace_back();
  base::expectError([&] { requireSame(cached, now); }, "sentinel", "its figures differ");
}

} // namespace
} // namespace parity::job
