// The part of a sun's map that a view needs: it holds what is seen, is as small as that, and depends on nothing else.
#include "gpu/shadows/shadow_window.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/small_scenes.h"

namespace parity::gpu {
namespace {

ShadowView makeWhole() {
  ShadowView view;
  view.orthographic = true;
  view.extent = 500;
  view.origin = {10, 20, 30};
  view.far = 100;
  view.side = 1024;
  return view;
}

std::vector<glm::vec4> positionsAbout(const ShadowView& view, const glm::vec2& center, float radius, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<glm::vec4> positions;
  for (int i = 0; i < 200; ++i)
    positions.emplace_back(view.origin + (center.x + radius * unit(random)) * view.right +
                               (center.y + radius * unit(random)) * view.up + 40 * unit(random) * view.forward,
                           0.f);
  return positions;
}

TEST(ShadowWindow, HoldsWhatIsSeenAndIsAsSmall) {
  const ShadowView whole = makeWhole();
  for (int seed = 0; seed < 60; ++seed) {
    const float radius = 300 * std::pow(0.8f, static_cast<float>(seed));
    const glm::vec2 center(100 * std::sin(1.f * seed), 90 * std::cos(2.f * seed));
    const auto positions = positionsAbout(whole, center, radius, seed);
    const ShadowWindow window = windowAbout(whole, positions);
    const ShadowView view = throughWindow(whole, window, {}, 3);
    EXPECT_TRUE(holds(whole, window, positions));
    if (window.level > 4 && window.level < kMaxWindowLevel) {
      EXPECT_FALSE(holds(whole, window, positionsAbout(whole, center + 5.f * radius, radius, seed)));
    }
    for (const glm::vec4& p : positions) {
      const glm::vec3 d = glm::vec3(p) - view.origin;
      EXPECT_LE(std::abs(glm::dot(view.right, d)), view.extent * 1.0001f);
      EXPECT_LE(std::abs(glm::dot(view.up, d)), view.extent * 1.0001f);
    }
    if (window.level > 0 && window.level < kMaxWindowLevel) {
      EXPECT_LT(view.extent, 3 * radius) << seed;
    }
    EXPECT_EQ(view.near, whole.near);
    EXPECT_EQ(view.far, whole.far);
  }
}

TEST(ShadowWindow, IsTheWholeWhereMostOfItIsSeenOrNone) {
  const ShadowView whole = makeWhole();
  EXPECT_EQ(windowAbout(whole, positionsAbout(whole, {0, 0}, 300, 1)), ShadowWindow());
  EXPECT_EQ(windowAbout(whole, positionsAbout(whole, {5000, 0}, 3, 1)), ShadowWindow()) << "beside it";
  EXPECT_EQ(windowAbout(whole, {}), ShadowWindow());
  auto spoilt = positionsAbout(whole, {50, 0}, 3, 1);
  const ShadowWindow clean = windowAbout(whole, spoilt);
  spoilt.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.f, 0.f, 0.f);
  spoilt.emplace_back(std::numeric_limits<float>::infinity(), 0.f, 0.f, 0.f);
  EXPECT_EQ(windowAbout(whole, spoilt), clean);
  EXPECT_GT(clean.level, 4u);
}

TEST(ShadowWindow, DrawsWhatTouchesIt) {
  ShadowView whole = makeWhole();
  std::vector<Caster> casters;
  for (int i = 0; i < 3; ++i) {
    Caster caster;
    caster.instance = static_cast<std::uint32_t>(2 * i);
    for (unsigned c = 0; c < 8; ++c)
      caster.corners[c] = whole.origin + (100.f * static_cast<float>(i) + (c & 1 ? 2.f : -2.f)) * whole.right +
                          (c & 2 ? 2.f : -2.f) * whole.up + (c & 4 ? 90.f : 5.f) * whole.forward;
    casters.push_back(caster);
    if (i != 2) whole.casters.push_back(caster.instance);
  }
  const auto seen = [&](float x) {
    return throughWindow(whole, windowAbout(whole, positionsAbout(whole, {x, 0}, 1, 1)), casters, 3).casters;
  };
  EXPECT_EQ(seen(100), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(seen(0), (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(seen(200).empty()) << "it casts nothing for this light";
}

} // namespace
} // namespace parity::gpu
