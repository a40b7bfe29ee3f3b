// A run's settings as a report lists them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/color.h"
#include "gpu/device_report.h"
#include "job/settings.h"

namespace parity::job {

// Name and value, in a fixed order. device: that the run takes; it decides what the mobile path computes in.
std::vector<std::pair<std::string, std::string>>
describeSettings(const Settings& settings, const base::DisplayTransform& display, const gpu::DeviceReport& device);

} // namespace parity::job
