// A scene request from the common options.
#pragma once

#include <string>

#include "cli/invocation.h"
#include "job/prepared_scene.h"

namespace parity::cli {

// The one view, environment and sun of the command line for this scene; named by the file's stem.
job::SceneRequest sceneRequest(const CommonOptions& common, const std::string& scene);

} // namespace parity::cli
