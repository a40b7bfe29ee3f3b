// jemalloc, which programs use in place of the C library's allocator: its settings (jemalloc(3), version 5.3).
//
// A report takes and frees hundreds of megabytes again and again: pictures, environments, the memory of a software
// driver. The C library gives large blocks back to the system, which then makes and clears each page of 4 KiB anew.
#include "base/allocator.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include <jemalloc/jemalloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

// The settings:
//   dirty_decay_ms:-1         keeps what was freed for the next block
//   oversize_threshold        blocks of 1 MiB and more share one arena: what one thread freed serves another
//   lg_extent_max_active_fit  a freed block also serves a request of a 4096th of its size. By default that is a 64th,
//                             and a run of several scenes takes up to 1.2 times the memory
#define PARITY_SETTINGS "dirty_decay_ms:-1,oversize_threshold:1048576,lg_extent_max_active_fit:12"

// jemalloc reads this at the first allocation; the environment variable MALLOC_CONF comes after it. Set by
// chooseSettings.
const char* malloc_conf = nullptr;

namespace parity::base {

bool areLargePagesFaster(std::span<double> touches) {
  const auto middle = touches.begin() + static_cast<std::ptrdiff_t>(touches.size() / 2);
  std::nth_element(touches.begin(), middle, touches.end());
  return *middle > 4e-6;
}

namespace {

constexpr std::size_t kRegionBytes = std::size_t{1} << 30, kPage = 4096, kTouches = 64;

// In seconds, for pages that nothing has touched; zeros if mmap fails. It allocates nothing.
std::array<double, kTouches> touchPages() {
  std::array<double, kTouches> seconds{};
  void* pages = mmap(nullptr, kTouches * kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) return seconds;
  auto* page = static_cast<volatile std::byte*>(pages);
  for (double& each : seconds) {
    const auto begin = std::chrono::steady_clock::now();
    *page = std::byte{1};
    each = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    page += kPage;
  }
  munmap(pages, kTouches * kPage);
  return seconds;
}

// Large pages are for all memory, also the driver's. jemalloc asks for them where the system's setting is `madvise`
// (/sys/kernel/mm/transparent_hugepage/enabled).
void chooseSettings() {
  std::array<double, kTouches> touches = touchPages();
  malloc_conf = areLargePagesFaster(touches) ? PARITY_SETTINGS ",thp:always" : PARITY_SETTINGS;
}

// The C library calls this before the constructors of all libraries, so before jemalloc's, too.
[[gnu::section(".preinit_array"), gnu::used]] void (*beforeConstructors)() = chooseSettings;

// Gives the arena of large blocks one region of addresses, no memory. Without it regions begin small and double. Freed
// neighbours in two regions are not joined, so what is freed fits fewer of the blocks that follow: twelve textures of
// 2048x2048 took 1.3 times the memory. Where addresses are limited or refused, nothing changes.
[[gnu::constructor]] void reserveRegion() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return;
  void* region = mallocx(kRegionBytes, 0);
  if (!region) return;
  unsigned arena = 0;
  std::size_t size = sizeof(arena);
  const bool isFound = mallctl("arenas.lookup", &arena, &size, &region, sizeof(region)) == 0;
  dallocx(region, 0);
  if (isFound) mallctl(("arena." + std::to_string(arena) + ".purge").c_str(), nullptr, nullptr, nullptr, 0);
}

} // namespace

} // namespace parity::base
