// Work in the background: its loops leave a core to others until somebody waits, and what it makes or throws arrives.
#include "base/background.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace parity::base {
namespace {

using Threads = std::set<std::thread::id>;

// The threads that a loop runs on; its ranges are long enough for all of them to come.
Threads threadsOfLoop() {
  std::mutex mutex;
  Threads threads;
  parallelFor(64, 1, [&](std::size_t, std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads;
}

TEST(LoopsInBackground, RunOnTheirOwnThreadUntilSomebodyWaits) {
  const ThreadLimit limit(2);
  if (threadCount() < 2) GTEST_SKIP() << "needs two cores";
  std::atomic<bool> isWaitedFor = false;
  const LoopsInBackground background(isWaitedFor);
  EXPECT_EQ(threadsOfLoop(), Threads{std::this_thread::get_id()});
  isWaitedFor = true;
  EXPECT_EQ(threadsOfLoop().size(), 2u);
}

TEST(LoopsInBackground, ComesBackToTheOneAround) {
  const ThreadLimit limit(2);
  std::atomic<bool> outer = false, inner = true;
  const LoopsInBackground background(outer);
  { const LoopsInBackground nested(inner); }
  EXPECT_EQ(threadsOfLoop(), Threads{std::this_thread::get_id()});
}

TEST(LoopsInBackground, CoverEachIndexOnceWhereSomebodyBeginsToWait) {
  const ThreadLimit limit(2);
  for (const std::size_t first : {0u, 1u, 7u, 32u, 33u}) { // of the ranges that sees it
    std::atomic<bool> isWaitedFor = first == 0;
    std::vector<std::atomic<int>> visits(100);
    const LoopsInBackground background(isWaitedFor);
    parallelFor(100, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
      if (begin == 3 * (first - 1)) isWaitedFor = true;
    });
    for (const auto& visit : visits) ASSERT_EQ(visit, 1) << first;
  }
}

TEST(LoopsInBackground, UseAllThreadsWhereThereAreMore) {
  if (threadCount() < 3) GTEST_SKIP() << "needs three cores";
  std::atomic<bool> isWaitedFor = false;
  const LoopsInBackground background(isWaitedFor);
  EXPECT_GT(threadsOfLoop().size(), 1u);
}

TEST(Background, GivesWhatWasMade) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const auto result = Background<std::string>::begin([] { return std::string("made"); });
    const Background<std::string> copy = result;
    EXPECT_TRUE(copy.isValid());
    EXPECT_EQ(copy.get(), "made") << threads;
    EXPECT_EQ(&copy.get(), &result.get()) << "one result, made once";
    EXPECT_TRUE(result.isIdle());
  }
  EXPECT_FALSE(Background<int>().isValid());
}

TEST(Background, OfOneThreadIsMadeWhereItIsWaitedFor) {
  const ThreadLimit limit(1);
  std::thread::id maker;
  const auto result = Background<int>::begin([&] {
    maker = std::this_thread::get_id();
    return 1;
  });
  EXPECT_TRUE(result.isIdle());
  EXPECT_EQ(maker, std::thread::id());
  result.wait();
  EXPECT_EQ(maker, std::this_thread::get_id());
}

TEST(Background, ThrowsWhatWasThrownWhereItIsTaken) {
  const auto result = Background<int>::begin([]() -> int { throw std::runtime_error("no"); });
  EXPECT_NO_THROW(result.wait());
  EXPECT_NO_THROW(result.waitPatiently());
  EXPECT_THROW(result.get(), std::runtime_error);
  EXPECT_THROW(result.get(), std::runtime_error) << "each time";
}

// Whoever waits lets its loops take all cores; whoever comes next in the background does not.
TEST(Background, LoopsKnowWhoWaits) {
  const ThreadLimit limit(2);
  std::atomic<bool> goesOn = false;
  const auto first = Background<int>::begin([&] {
    while (!goesOn) std::this_thread::yield();
    return 1;
  });
  const auto second = Background<std::size_t>::begin([&] {
    first.waitPatiently();
    return threadsOfLoop().size();
  });
  goesOn = true;
  second.waitPatiently();
  EXPECT_EQ(second.get(), 1u);
}

} // namespace
} // namespace parity::base
