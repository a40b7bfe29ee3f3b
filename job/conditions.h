// All that decides a result, as lists made of the table of knobs: from them come the key of the cache, what the report
// records and its settings, and what a run is held to when it is compared with a baseline.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/pooling/condition.h"
#include "gpu/device/device_report.h"
#include "job/scene_request.h"

namespace parity::job {

struct Conditions {
  std::vector<compare::Condition> run;                // the same for every scene that says nothing else
  std::vector<compare::Condition> scene;              // what it is, and what it says otherwise than the run
  std::vector<std::vector<compare::Condition>> views; // as many as the scene has
};

// Of a scene in a run of these settings on this device. Files count by their content; one that cannot be read is "not
// readable": loading the scene will say why.
Conditions conditionsOf(const Settings& run, const SceneRequest& request, const gpu::DeviceReport& device);

// Of every scene that says nothing else.
std::vector<compare::Condition> runConditions(const Settings& run, const gpu::DeviceReport& device);

// Those that some figure depends on: what a report holds.
std::vector<compare::Condition> reported(const std::vector<compare::Condition>& conditions);

// Of the names and values of all that act on the scene, also of those that act on nothing: 32 hexadecimal digits.
std::string hashOf(const Conditions& conditions);

// A run's settings as a report lists them: name and value for people, in the order of the knobs. device: that the run
// takes; it decides what the mobile path computes in.
std::vector<std::pair<std::string, std::string>> describeSettings(const Settings& settings,
                                                                  const gpu::DeviceReport& device);

} // namespace parity::job
