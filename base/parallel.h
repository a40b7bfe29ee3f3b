// Loops over all cores, by TBB.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace parity::base {

// Caps the worker threads of the whole process for its lifetime. threads <= 0: all cores.
class ThreadLimit {
public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

// How many threads a loop may use now: the cores, or what the smallest living ThreadLimit allows.
int threadCount();

// Calls body(begin, end) on disjoint ranges that cover [0, count), each of at most `grain` indices and starting at a
// multiple of it: the split does not depend on the number of threads, so sums per range are reproducible.
void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

// While it lives, loops of the thread that made it leave a core to others: where there are two, they run on this thread
// alone, until isWaitedFor is set. For work whose result is needed later than what runs beside it.
class LoopsInBackground {
public:
  explicit LoopsInBackground(const std::atomic<bool>& isWaitedFor);
  ~LoopsInBackground();
  LoopsInBackground(const LoopsInBackground&) = delete;
  LoopsInBackground& operator=(const LoopsInBackground&) = delete;

private:
  const std::atomic<bool>* m_outer; // of one around this; null: none
};

// Runs the tasks at the same time as far as there are threads (so none may wait for another). When all have ended,
// rethrows the exception of the first in the list that failed.
void parallelInvoke(const std::vector<std::function<void()>>& tasks);

} // namespace parity::base
