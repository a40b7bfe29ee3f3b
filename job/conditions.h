// All that decides a result, as one list: from it come the key of the cache, what the report records and its settings,
// and what a run is held to when it is compared with a baseline.
#pragma once

#include <string>
#include <vector>

#include "compare/condition.h"
#include "gpu/device_report.h"
#include "job/scene_request.h"
#include "job/settings.h"

namespace parity::job {

struct Conditions {
  std::vector<compare::Condition> run;                // the same for every scene
  std::vector<compare::Condition> scene;              // its own; where it says nothing, the run's
  std::vector<std::vector<compare::Condition>> views; // as many as the scene has
};

// Of a scene in a run on this device. Files count by their content; one that cannot be read is "not readable": loading
// the scene will say why. A new option is a row in conditions.cpp, which does not compile while a member is missing
// there.
Conditions conditionsOf(const Settings& settings, const SceneRequest& request, const gpu::DeviceReport& device);

// What the run says: its own conditions, and those of scenes that say nothing else.
std::vector<compare::Condition> runConditions(const Settings& settings, const gpu::DeviceReport& device);
std::vector<compare::Condition> defaultConditions(const Settings& settings, const SceneRequest& request);

// Those that some figure depends on: what a report holds.
std::vector<compare::Condition> reported(const std::vector<compare::Condition>& conditions);

// Of the names and values of all rows, also of those that act on nothing: 32 hexadecimal digits.
std::string hashOf(const Conditions& conditions);

} // namespace parity::job
