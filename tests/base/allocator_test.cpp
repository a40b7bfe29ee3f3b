// The allocator of programs (base/allocator.cpp), which is linked to this binary as to them.
#include "base/allocator.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <jemalloc/jemalloc.h>
#include <unistd.h>

namespace parity::base {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

template <typename T> T option(const char* name) {
  T value{};
  std::size_t size = sizeof(value);
  EXPECT_EQ(mallctl(name, &value, &size, nullptr, 0), 0) << name;
  return value;
}

long residentMiB() {
  std::ifstream file("/proc/self/statm");
  long size = 0, resident = 0;
  file >> size >> resident;
  return resident * sysconf(_SC_PAGESIZE) / static_cast<long>(kMiB);
}

// In a thread of its own, which has another arena than the one before.
void takeAndFree(std::size_t bytes) {
  std::thread([&] { EXPECT_EQ(std::vector<char>(bytes, 'x').back(), 'x'); }).join();
}

TEST(Allocator, HasTheSettingsOfThePrograms) {
  // The program chose when it started; jemalloc must have read it after that, or it has its own defaults.
  ASSERT_NE(malloc_conf, nullptr) << "nothing was chosen";
  const bool areLarge = std::string_view(malloc_conf).ends_with(",thp:always");
  const std::string_view thp = option<const char*>("opt.thp");
  EXPECT_TRUE(thp == (areLarge ? "always" : "default") || thp == "not supported") << thp;
  EXPECT_EQ(option<std::ptrdiff_t>("opt.dirty_decay_ms"), -1);
  EXPECT_EQ(option<std::size_t>("opt.oversize_threshold"), kMiB);
  EXPECT_EQ(option<std::size_t>("opt.lg_extent_max_active_fit"), 12u);
}

TEST(Allocator, AsksForLargePagesWhereMostSmallOnesAreSlow) {
  std::vector<double> touches(64, 1e-6);
  std::fill_n(touches.begin(), 31, 1e-3); // a busy machine
  EXPECT_FALSE(areLargePagesFaster(touches));
  touches.assign(64, 7e-6);
  std::fill_n(touches.begin(), 31, 1e-7);
  EXPECT_TRUE(areLargePagesFaster(touches));
  EXPECT_FALSE(areLargePagesFaster(std::span(touches).first(1))) << "the only one is fast";
}

TEST(Allocator, WhatOneThreadFreedServesAnother) {
  const long before = residentMiB();
  takeAndFree(200 * kMiB);
  const long after = residentMiB();
  EXPECT_GT(after, before + 190) << "it is kept";
  for (int i = 0; i < 3; ++i) takeAndFree(200 * kMiB);
  EXPECT_LT(residentMiB(), after + 20);
}

// A block that is still in use lies beside it.
TEST(Allocator, ALargeFreedBlockServesSmallOnes) {
  std::vector<char> large(256 * kMiB, 'l'), below(kMiB, 'b');
  const long before = residentMiB();
  std::vector<char>().swap(large);
  std::vector<std::vector<char>> small;
  for (int i = 0; i < 200; ++i) small.emplace_back(kMiB, 's');
  EXPECT_LT(residentMiB(), before + 20);
}

// Freed blocks of 12 MiB, one after another, make room for others of 18: they are joined. The test notices a missing
// region only where it is the first of its process, as ctest runs it.
TEST(Allocator, FreedNeighboursAreJoined) {
  std::vector<std::vector<char>> small, large;
  for (int i = 0; i < 20; ++i) small.emplace_back(12 * kMiB, 's');
  const long before = residentMiB();
  for (std::size_t i = 0; i < small.size(); ++i) {
    std::vector<char>().swap(small[i]);
    if (i % 3 == 2) large.emplace_back(18 * kMiB, 'l'), large.emplace_back(18 * kMiB, 'l');
  }
  EXPECT_LT(residentMiB(), before + 60);
}

} // namespace
} // namespace parity::base
