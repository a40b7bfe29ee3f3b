#include "study/explain/two_devices.h"

#include <atomic>
#include <future>

#include "base/parallel.h"
#include "job/context.h"

namespace parity::explain {

void onTwoDevices(job::Context& context, std::size_t count,
                  const std::function<void(job::Context& context, std::size_t place)>& act) {
  std::atomic<std::size_t> next = 0;
  const auto takeAll = [&](job::Context& own) {
    try {
      for (std::size_t i = next++; i < count; i = next++) act(own, i);
    } catch (...) {
      next = count; // the other begins no more
      throw;
    }
  };
  // What a driver does for hardware does not get faster by a second device.
  const bool isSoftware = context.deviceReport().kind == "cpu";
  if (count < 2 || base::threadCount() < 2 || !isSoftware) return takeAll(context);
  if (context.cache().enabled()) context.numerics(); // once for both
  job::Context second(context, job::Context::ForAnotherThread{});
  std::future<void> other = std::async(std::launch::async, [&] { takeAll(second); });
  takeAll(context);
  other.get();
  context.take(second);
}

} // namespace parity::explain
