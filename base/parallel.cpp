// Loops over all cores: fixed ranges on TBB's workers.
#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <exception>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace parity::base {

struct ThreadLimit::Impl {
  explicit Impl(std::size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control; // its copies would not count
};

ThreadLimit::ThreadLimit(int threads)
    : m_impl(
          std::make_unique<Impl>(static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency()))) {}

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
  // Isolated: while it waits for its own ranges, a thread takes no task of an outer loop, which might want a lock that
  // the caller holds.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, ranges, runRange, tbb::simple_partitioner{}); });
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
