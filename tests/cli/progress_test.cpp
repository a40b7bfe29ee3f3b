// The line of the progress bar.
#include <gtest/gtest.h>

#include "base/text/text.h"
#include "cli/progress.h"

namespace parity::cli {
namespace {

TEST(Progress, SaysShareElapsedAndRemainingTime) {
  const std::string line = describeProgress("1 of 4 done, desk: truth", 0.25, 30, 120);
  EXPECT_TRUE(line.ends_with("  25 % 0:30, about 1:30 left  1 of 4 done, desk: truth")) << line;
  EXPECT_TRUE(line.starts_with("██████░░░░")) << line;
  EXPECT_TRUE(describeProgress("x", 0.5, 7200, 120).ends_with(" 50 % 2:00:00, about 2:00:00 left  x"));
}

TEST(Progress, SaysNothingOfTheRestBeforeThePaceIsKnown) {
  EXPECT_TRUE(describeProgress("x", 0.5, 1, 120).ends_with(" 50 % 0:01  x")) << "a second is no pace";
  EXPECT_TRUE(describeProgress("x", 0.001, 60, 120).ends_with("  0 % 1:00  x")) << "it would be hours, or minutes";
  EXPECT_TRUE(describeProgress("x", 0, 60, 120).ends_with("  0 % 1:00  x"));
}

TEST(Progress, FitsTheLineAndHoldsNoEscapes) {
  for (const std::size_t columns : {20u, 40u, 79u}) {
    const std::string line = describeProgress(std::string(200, 'x') + "\x1b[31m", 0.5, 10, columns);
    EXPECT_LE(base::displayWidth(line), columns);
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
  }
}

TEST(Progress, OfAScenePutsItAmongTheOthers) {
  std::string told;
  double share = 0;
  const job::Progress whole = [&](const std::string& what, double done) { told = what, share = done; };
  progressOfScene(whole, 1, 4)("desk: truth", 0.5);
  EXPECT_EQ(told, "1 of 4 done, desk: truth");
  EXPECT_EQ(share, 0.375);
  progressOfScene(whole, 0, 1)("desk: truth", 0.5);
  EXPECT_EQ(told, "desk: truth") << "there is nothing to count";
  EXPECT_FALSE(progressOfScene({}, 1, 4)) << "nobody is told";
}

} // namespace
} // namespace parity::cli
