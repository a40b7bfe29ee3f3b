#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "gpu/surface/shaded_plane.h"
#include "support/shaded_values.h"

namespace parity::gpu {
namespace {

constexpr glm::vec4 kRed(1, 0, 0, 0.5f), kBlue(0, 0, 2, 1);

TEST(ShadedPlane, HoldsItsValues) {
  const ShadedPlane plane = {kRed, kBlue};
  EXPECT_EQ(plane.size(), 2u);
  EXPECT_EQ(plane[1], kBlue);
  EXPECT_TRUE(ShadedPlane().empty());
}

TEST(ShadedPlane, OfZerosHasThemAtEveryEntry) {
  const ShadedPlane plane = ShadedPlane::zeros(3);
  EXPECT_EQ(tests::valuesOf(plane), std::vector<glm::vec4>(3, glm::vec4(0)));
  const PlaneView view = plane;
  EXPECT_EQ(view[2], glm::vec4(0));
}

TEST(ShadedPlane, KeepsWhatItReadsInPlace) {
  auto owner = std::make_shared<const std::vector<glm::vec4>>(3, kBlue);
  const std::weak_ptr<const std::vector<glm::vec4>> watched = owner;
  const glm::vec4* values = owner->data();
  auto first = std::make_unique<ShadedPlane>(owner, std::span(values + 1, 2));
  owner.reset();
  const ShadedPlane copy = *first;
  first.reset();
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(&copy[0], values + 1) << "not copied";
  EXPECT_EQ(copy.size(), 2u);
}

TEST(ShadedPlane, IsEmptyWhenMovedFrom) {
  ShadedPlane first = {kRed};
  const ShadedPlane second = std::move(first);
  EXPECT_TRUE(first.empty()); // NOLINT(bugprone-use-after-move): that is what the test asks
  EXPECT_EQ(second[0], kRed);
  ShadedPlane third = {kBlue, kBlue};
  third = second;
  EXPECT_EQ(tests::valuesOf(third), std::vector<glm::vec4>{kRed});
}

TEST(ShadedPlane, IsBlackWhereAllRadianceIsZero) {
  EXPECT_TRUE(ShadedPlane::zeros(2).isBlack());
  EXPECT_TRUE(ShadedPlane({glm::vec4(0, -0.f, 0, 1)}).isBlack()) << "the fourth value is no radiance";
  EXPECT_FALSE(ShadedPlane({glm::vec4(0), kBlue}).isBlack());
  EXPECT_FALSE(ShadedPlane({glm::vec4(0, std::numeric_limits<float>::quiet_NaN(), 0, 0)}).isBlack());
}

} // namespace
} // namespace parity::gpu
