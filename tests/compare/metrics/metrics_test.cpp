// What is not finite is found.
#include <limits>

#include <gtest/gtest.h>

#include "compare/metrics/metrics.h"
#include "support/not_finite.h"

namespace parity::compare {
namespace {

using tests::kInf, tests::kNan;

TEST(NonFinite, IsCountedPerPixelWithTheFirstInRowOrder) {
  base::Image image(300, 4, 3, -1e38f);
  EXPECT_EQ(countNonFinite(image).count, 0u);
  image.at(7, 3)[0] = kNan;
  image.at(299, 1)[2] = -kInf;
  image.at(299, 1)[1] = kInf;
  image.at(3, 3)[1] = kInf;
  const NonFinite found = countNonFinite(image);
  EXPECT_EQ(found.count, 3u);
  EXPECT_EQ(found.x, 299);
  EXPECT_EQ(found.y, 1);
}

} // namespace
} // namespace parity::compare
