// Wall time by stage.
#include "base/stopwatch.h"

#include <thread>

#include <gtest/gtest.h>

namespace parity::base {
namespace {

TEST(Timings, AddUpByStageInOrderOfFirstUse) {
  Timings timings;
  timings.add("load", 1);
  timings.add("render", 2);
  timings.add("load", 4);
  EXPECT_EQ(timings.stages(), (std::vector<std::pair<std::string, double>>{{"load", 5}, {"render", 2}}));
}

TEST(Timings, TakeManyThreads) {
  Timings timings;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 1000; ++k) timings.add("stage", 1);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(timings.stages().at(0).second, 4000);
}

TEST(Stopwatch, AddsItsLifetime) {
  Timings timings;
  {
    const Stopwatch watch(&timings, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_GE(watch.elapsedMs(), 5);
  }
  ASSERT_EQ(timings.stages().size(), 1u);
  EXPECT_GE(timings.stages()[0].second, 5);
  EXPECT_NO_THROW(Stopwatch(nullptr, "unwatched"));
}

} // namespace
} // namespace parity::base
