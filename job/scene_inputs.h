// What a scene and a run are made from, as digests: history names the cause of a change by them.
#pragma once

#include <string>
#include <vector>

#include "job/conditions.h"
#include "report/report.h"
#include "scenes/scene.h"

namespace parity::job {

// sources: the files that the scene was read from; where there are none of a scene that has files, its asset is not
// known. conditions: of the scene, as conditionsOf() makes them; empty where they are not known.
report::SceneInputs inputsOf(const SceneRequest& request, const Conditions& conditions,
                             const std::vector<scenes::SourceFile>& sources);

// Of the conditions of a run: names and values, 32 hexadecimal digits.
std::string digestOf(const std::vector<compare::Condition>& conditions);

} // namespace parity::job
