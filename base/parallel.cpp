// Loops over all cores: fixed ranges on TBB's workers.
#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <exception>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <fmt/format.h>

#include "base/log.h"

#ifdef __SANITIZE_THREAD__
#include <mutex>
#include <thread>

extern "C" const char* __tsan_default_suppressions() {
  return "race:libOpenImageIO\n"; // it is not built for the thread sanitizer
}
#endif

namespace parity::base {

namespace {

#ifdef __SANITIZE_THREAD__
// TBB's library is not built for the thread sanitizer, which therefore does not see what orders a loop's start, its
// tasks and its end. Here each loop has threads of its own. They end with it, and the first exception is thrown.
void runRanges(std::size_t first, std::size_t ranges, const std::function<void(std::size_t)>& runRange) {
  std::atomic<std::size_t> next = first;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    for (std::size_t i = next++; i < ranges; i = next++) try {
        runRange(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = ranges;
      }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t others = std::min<std::size_t>(ranges - first, static_cast<std::size_t>(threadCount())) - 1;
    for (std::size_t i = 0; i < others; ++i) threads.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}
#else
// Isolated: while it waits for its own ranges, a thread takes no task of an outer loop, which might want a lock that
// the caller holds.
void runRanges(std::size_t first, std::size_t ranges, const auto& runRange) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(first, ranges, runRange, tbb::simple_partitioner{}); });
}
#endif

// Of the thread's LoopsInBackground; null: none.
thread_local const std::atomic<bool>* tIsWaitedFor = nullptr;

} // namespace

LoopsInBackground::LoopsInBackground(const std::atomic<bool>& isWaitedFor) : m_outer(tIsWaitedFor) {
  tIsWaitedFor = &isWaitedFor;
}

LoopsInBackground::~LoopsInBackground() { tIsWaitedFor = m_outer; }

struct ThreadLimit::Impl {
  explicit Impl(std::size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control; // its copies would not count
};

ThreadLimit::ThreadLimit(int threads)
    : m_impl(
          std::make_unique<Impl>(static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency()))) {
  logDetail(fmt::format("threads: {}", threadCount()));
}

ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min<std::size_t>(allowed, tbb::info::default_concurrency()));
}

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  assert(grain > 0);
  const std::size_t ranges = count / grain + (count % grain != 0);
  const auto runRange = [&](std::size_t i) { body(i * grain, i * grain + std::min(grain, count - i * grain)); };
  if (ranges == 1) return runRange(0);
  std::size_t first = 0;
  if (tIsWaitedFor && threadCount() <= 2)
    while (first < ranges && !*tIsWaitedFor) runRange(first++);
  if (first < ranges) runRanges(first, ranges, runRange);
}

void parallelInvoke(const std::vector<std::function<void()>>& tasks) {
  // Kept per task: TBB itself would drop the tasks that have not begun when one throws.
  std::vector<std::exception_ptr> failures(tasks.size());
  parallelFor(tasks.size(), 1, [&](std::size_t begin, std::size_t) {
    try {
      tasks[begin]();
    } catch (...) {
      failures[begin] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

} // namespace parity::base
