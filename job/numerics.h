// The numerics id: how this machine rounds. Figures of two machines are the same bytes only where it is the same.
#pragma once

#include <string>

namespace parity::job {

class Context;

// A hash, 32 hexadecimal digits, over bits of the C library's mathematics, of the vectorised metrics and of the device
// (gpu/device/numerics.h), on fixed inputs. Makes the device, unless the cache knows its part by build, host, device,
// processor and what the environment tells the driver. Throws Error (exit 4) where there is no device.
std::string numericsId(Context& context);

// The same without the device, measured once a process.
const std::string& hostNumerics();

} // namespace parity::job
