// A result that another thread makes while this one goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "base/parallel.h"

namespace parity::base {

// Its loops leave a core to others until somebody waits for the result (LoopsInBackground). With one thread it is made
// where it is waited for. Copies are of the same result. The last one's destructor waits, too: what `make` refers to
// must outlive it.
template <typename T> class Background {
public:
  Background() = default; // no result; only assigning and isValid() make sense

  template <typename Make> static Background begin(Make make) {
    Background result;
    result.m_isWaitedFor = std::make_shared<std::atomic<bool>>(false);
    const auto policy = threadCount() > 1 ? std::launch::async : std::launch::deferred;
    result.m_made = std::async(policy, [make = std::move(make), isWaitedFor = result.m_isWaitedFor]() mutable {
                      const LoopsInBackground background(*isWaitedFor);
                      return make();
                    }).share();
    return result;
  }

  bool isValid() const { return m_made.valid(); }
  // Whether no other thread is at work for it.
  bool isIdle() const { return m_made.wait_for(std::chrono::seconds(0)) != std::future_status::timeout; }
  void wait() const {
    *m_isWaitedFor = true;
    m_made.wait();
  }
  // For what comes next in the background: its loops still leave a core to others.
  void waitPatiently() const { m_made.wait(); }
  // Throws what `make` has thrown.
  const T& get() const {
    wait();
    return m_made.get();
  }

private:
  std::shared_ptr<std::atomic<bool>> m_isWaitedFor;
  std::shared_future<T> m_made;
};

} // namespace parity::base
