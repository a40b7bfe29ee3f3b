// What decides a scene's figures, as digests: so that a figure that changed can name what did.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "job/conditions.h"
#include "report/report.h"
#include "scenes/scene.h"

namespace parity::job {

// sources: the files that the scene was read from, its own first, and the pictures of other engines. Nothing where it
// has not been read: a built-in scene has no files, and counts by its name.
std::optional<report::SceneInputs> inputsOf(const SceneRequest& request, const Conditions& conditions,
                                            const std::vector<scenes::SourceFile>& sources);

// Of those conditions of a run that act on figures: names and values, whatever their order. 12 hexadecimal digits.
std::string digestOf(std::vector<compare::Condition> conditions);

} // namespace parity::job
