// jemalloc, which programs use in place of the C library's allocator: its settings (jemalloc(3), version 5.3).
//
// A report takes and frees hundreds of megabytes again and again: pictures, environments, the memory of a software
// driver. The C library gives large blocks back to the system, which then makes and clears each page of 4 KiB anew.
#include "base/allocator.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include <jemalloc/jemalloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

// jemalloc reads this before the first allocation; the environment variable MALLOC_CONF comes after it.
//   dirty_decay_ms:-1         keeps what was freed for the next block
//   oversize_threshold        blocks of 1 MiB and more share one arena: what one thread freed serves another
//   lg_extent_max_active_fit  a freed block also serves a request of a 4096th of its size. By default that is a 64th,
//                             and a run of several scenes takes up to 1.2 times the memory
const char* malloc_conf = "dirty_decay_ms:-1,oversize_threshold:1048576,lg_extent_max_active_fit:12";

namespace parity::base {

bool areLargePagesFaster(std::span<double> touches) {
  const auto middle = touches.begin() + static_cast<std::ptrdiff_t>(touches.size() / 2);
  std::nth_element(touches.begin(), middle, touches.end());
  return *middle > 4e-6;
}

namespace {

constexpr std::size_t kRegionBytes = std::size_t{1} << 30, kPage = 4096;

// A region may begin inside a page.
void* firstPage(void* region) {
  return reinterpret_cast<void*>((reinterpret_cast<std::uintptr_t>(region) + kPage - 1) / kPage * kPage);
}

// In seconds, for 64 pages of a region that nothing has touched.
std::array<double, 64> touchPages(void* region) {
  using Clock = std::chrono::steady_clock;
  auto* page = static_cast<volatile std::byte*>(firstPage(region));
  std::array<double, 64> seconds{};
  for (double& each : seconds) {
    const Clock::time_point begin = Clock::now();
    *page = std::byte{1};
    each = std::chrono::duration<double>(Clock::now() - begin).count();
    page += kPage;
  }
  return seconds;
}

// Gives the arena of large blocks one region of addresses, no memory. Without it regions begin small and double. Freed
// neighbours in two regions are not joined, so what is freed fits fewer of the blocks that follow: twelve textures of
// 2048x2048 took 1.3 times the memory. Where addresses are limited or refused, nothing changes.
[[gnu::constructor]] void reserveRegion() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return;
  void* region = mallocx(kRegionBytes, 0);
  if (!region) return;
  std::array<double, 64> touches = touchPages(region);
  if (areLargePagesFaster(touches)) madvise(firstPage(region), kRegionBytes - kPage, MADV_HUGEPAGE);
  unsigned arena = 0;
  std::size_t size = sizeof(arena);
  const bool isFound = mallctl("arenas.lookup", &arena, &size, &region, sizeof(region)) == 0;
  dallocx(region, 0);
  if (isFound) mallctl(("arena." + std::to_string(arena) + ".purge").c_str(), nullptr, nullptr, nullptr, 0);
}

} // namespace

} // namespace parity::base
