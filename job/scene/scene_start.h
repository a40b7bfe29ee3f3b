// What a report says of a scene whatever becomes of it.
#pragma once

#include <string>

#include "job/scene_request.h"
#include "report/report.h"

namespace parity::job {

// Its name, its file, and its light, as they were asked for; nothing is read.
report::SceneResult startScene(const SceneRequest& request);

// A message without the folders of the scene's files: a report does not say where on this machine they lie.
std::string withoutFolders(std::string text, const SceneRequest& request);

} // namespace parity::job
