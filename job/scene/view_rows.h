// The rows of a scene's report: each view by each of the paths that are compared with the first.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "job/scene_request.h"

namespace parity::job {

// Places in the request, and in the choice of paths.
struct ViewOfPath {
  std::size_t view = 0, test = 1;
};

// In the order of the report.
void forEachView(const SceneRequest& request, auto&& act) {
  for (std::size_t v = 0; v < request.views.size(); ++v)
    for (std::size_t test = 1; test < request.settings.pathNames.size(); ++test) act(ViewOfPath{v, test});
}

// Its place among the rows.
std::size_t rowOf(const SceneRequest& request, const ViewOfPath& view);

// The view's name; behind it that of the path, which the first of the paths does not need.
std::string viewName(const SceneRequest& request, const ViewOfPath& view);

// What the names of each row's pictures begin with. sceneIndex: the scene's place in the run.
std::vector<std::string> prefixesOf(const SceneRequest& request, std::size_t sceneIndex);

} // namespace parity::job
