// The allocator of programs (base/allocator.cpp), which is linked to this binary as to them.
#include <cstddef>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/freed_memory.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PARITY_SKIP_WITHOUT_ALLOCATOR GTEST_SKIP() << "sanitizers bring an allocator of their own"
extern "C" int mallctl(const char*, void*, std::size_t*, void*, std::size_t) { return 1; }
#else
#define PARITY_SKIP_WITHOUT_ALLOCATOR
#include <jemalloc/jemalloc.h>
#endif

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
  PARITY_SKIP_WITHOUT_ALLOCATOR;
  EXPECT_STREQ(option<const char*>("opt.thp"), "always");
  EXPECT_EQ(option<std::ptrdiff_t>("opt.dirty_decay_ms"), -1);
  EXPECT_EQ(option<std::size_t>("opt.oversize_threshold"), kMiB);
}

TEST(Allocator, WhatOneThreadFreedServesAnother) {
  PARITY_SKIP_WITHOUT_ALLOCATOR;
  const long before = residentMiB();
  takeAndFree(200 * kMiB);
  const long after = residentMiB();
  EXPECT_GT(after, before + 190) << "it is kept";
  for (int i = 0; i < 3; ++i) takeAndFree(200 * kMiB);
  EXPECT_LT(residentMiB(), after + 20);
}

// Freed blocks of 12 MiB, one after another, make room for others of 18: they are joined. Only as the first test of its
// process, as ctest runs it, does it notice where there is no region.
TEST(Allocator, FreedNeighboursAreJoined) {
  PARITY_SKIP_WITHOUT_ALLOCATOR;
  returnFreedMemory();
  std::vector<std::vector<char>> small, large;
  for (int i = 0; i < 20; ++i) small.emplace_back(12 * kMiB, 's');
  const long before = residentMiB();
  for (std::size_t i = 0; i < small.size(); ++i) {
    std::vector<char>().swap(small[i]);
    if (i % 3 == 2) large.emplace_back(18 * kMiB, 'l'), large.emplace_back(18 * kMiB, 'l');
  }
  EXPECT_LT(residentMiB(), before + 60);
}

TEST(Allocator, ReturnsWhatWasFreedWhenAsked) {
  PARITY_SKIP_WITHOUT_ALLOCATOR;
  takeAndFree(200 * kMiB);
  const long before = residentMiB();
  returnFreedMemory();
  EXPECT_LT(residentMiB(), before - 190);
}

} // namespace
} // namespace parity::base
