// A run's settings as a report lists them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gpu/device_report.h"
#include "job/settings.h"

namespace parity::job {

// Name and value for people, in a fixed order: the run's conditions (job/conditions.h), and those of scenes that say
// nothing else. device: that the run takes; it decides what the mobile path computes in.
std::vector<std::pair<std::string, std::string>> describeSettings(const Settings& settings,
                                                                  const gpu::DeviceReport& device);

// "mobile reflections scaled: mixing": what acts in a scene whose cubes are baked captures, or whose cube is the
// environment.
std::string describeCaptureScale(const mobile::Options& options, bool hasCaptures);

} // namespace parity::job
