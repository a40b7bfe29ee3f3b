// Loops over all cores: every index once, and the same split whatever the number of threads.
#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace parity::base {
namespace {

using Range = std::pair<std::size_t, std::size_t>;

std::set<Range> rangesOf(std::size_t count, std::size_t grain) {
  std::mutex mutex;
  std::set<Range> ranges;
  parallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(ranges.emplace(begin, end).second) << "twice: " << begin;
  });
  return ranges;
}

TEST(ParallelFor, CoversEachIndexOnce) {
  for (const std::size_t count : {0, 1, 15, 16, 17, 1000})
    for (const std::size_t grain : {1, 16, 1000, 5000}) {
      std::vector<std::atomic<int>> visits(count);
      parallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
        EXPECT_LT(begin, end);
        EXPECT_LE(end - begin, grain);
        EXPECT_EQ(begin % grain, 0u);
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& visit : visits) ASSERT_EQ(visit, 1) << count << " by " << grain;
    }
}

TEST(ParallelFor, SplitsAlikeWithAnyNumberOfThreads) {
  const std::set<Range> expected = rangesOf(1003, 10);
  EXPECT_EQ(expected.size(), 101u);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(rangesOf(1003, 10), expected) << threads;
  }
}

TEST(ParallelFor, DoesNotOverflowAtTheEndOfTheIndices) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(rangesOf(kMost, kMost), (std::set<Range>{{0, kMost}}));
  EXPECT_EQ(rangesOf(kMost, kMost - 1), (std::set<Range>{{0, kMost - 1}, {kMost - 1, kMost}}));
}

TEST(ParallelFor, PassesAnExceptionOn) {
  EXPECT_THROW(parallelFor(100, 1,
                           [](std::size_t begin, std::size_t) {
                             if (begin == 57) throw std::runtime_error("57");
                           }),
               std::runtime_error);
}

TEST(ParallelFor, MayBeCalledWithinItself) {
  std::atomic<int> sum = 0;
  parallelFor(20, 1, [&](std::size_t, std::size_t) {
    parallelFor(50, 4, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
  });
  EXPECT_EQ(sum, 1000);
}

TEST(ParallelFor, TakesNoOuterTaskWhileItWaitsForInnerOnes) {
  // Such a task might want a lock that the waiting caller holds. It takes three threads to happen: one that waits, one
  // that has its inner task, one with outer tasks left to steal; hence more than there may be cores.
  const ThreadLimit limit(4);
  std::atomic<int> nested = 0, sum = 0;
  tbb::task_arena(4).execute([&] {
    const std::thread::id self = std::this_thread::get_id();
    parallelFor(600, 1, [&](std::size_t, std::size_t) {
      static thread_local int depth = 0;
      if (++depth > 1) ++nested;
      const std::thread::id owner = std::this_thread::get_id();
      // One thread keeps outer tasks; what another takes of an inner loop, its owner must wait for.
      if (owner == self) std::this_thread::sleep_for(std::chrono::microseconds(300));
      parallelFor(8, 1, [&](std::size_t, std::size_t) {
        std::this_thread::sleep_for(std::chrono::microseconds(std::this_thread::get_id() == owner ? 20 : 400));
        ++sum;
      });
      --depth;
    });
  });
  EXPECT_EQ(nested, 0);
  EXPECT_EQ(sum, 600 * 8);
}

TEST(ThreadLimit, HoldsForAsLongAsItLives) {
  const int all = threadCount();
  EXPECT_GE(all, 1);
  {
    const ThreadLimit one(1);
    EXPECT_EQ(threadCount(), 1);
    const std::thread::id self = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    parallelFor(64, 1, [&](std::size_t, std::size_t) {
      if (std::this_thread::get_id() != self) ++elsewhere;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
    EXPECT_EQ(elsewhere, 0);
    const ThreadLimit none(0); // asks for all, but the smallest rules
    EXPECT_EQ(threadCount(), 1);
  }
  EXPECT_EQ(threadCount(), all);
}

TEST(ParallelInvoke, RunsEveryTask) {
  std::vector<int> done(10, 0);
  std::vector<std::function<void()>> tasks;
  for (int& flag : done) tasks.push_back([&flag] { flag = 1; });
  parallelInvoke(tasks);
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 10);
  EXPECT_NO_THROW(parallelInvoke({}));
}

TEST(ParallelInvoke, RethrowsTheFirstOfTheListAfterAllHaveEnded) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    std::atomic<int> ended = 0;
    std::vector<std::function<void()>> tasks(6, [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      ++ended;
    });
    tasks[1] = [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(10)); // later than the other, yet first in the list
      throw std::runtime_error("one");
    };
    tasks[4] = [] { throw std::runtime_error("four"); };
    try {
      parallelInvoke(tasks);
      ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "one");
    }
    EXPECT_EQ(ended, 4);
  }
}

} // namespace
} // namespace parity::base
