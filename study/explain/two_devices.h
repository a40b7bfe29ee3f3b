// Work that two devices share: the driver takes one core for much of what it does.
#pragma once

#include <cstddef>
#include <functional>

namespace parity::job {
class Context;
}

namespace parity::explain {

// Calls act for each number below count: two at a time where there are threads, each with a context of its own. What
// comes out must not depend on who takes which. The first exception leaves, once both are at an end.
void onTwoDevices(job::Context& context, std::size_t count,
                  const std::function<void(job::Context& context, std::size_t place)>& act);

} // namespace parity::explain
