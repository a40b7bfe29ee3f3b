// The rows of a scene's report: each view by each of the paths that are compared with the first, then by the pictures
// of other engines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "job/scene_request.h"

namespace parity::job {

// What a view is shown by: the paths of the settings, in their order, then the pictures of externals.
struct Column {
  std::string name;
  const scenes::ExternalPictures* external = nullptr; // null: a path
  std::string file;                                   // of an external: its picture's name, with {scene} and {view}
};
// They point into the request.
std::vector<Column> columnsOf(const SceneRequest& request);

// Throws Error (usage) for externals that no run can show: an unknown transfer or path, two references, names of paths.
void requireExternals(const SceneRequest& request);

// A view, and the columns that are compared.
struct ViewOfPath {
  std::size_t view = 0, test = 1, reference = 0;
  bool operator==(const ViewOfPath&) const = default;
};

// Of each view the same, in the order of the report.
std::vector<ViewOfPath> rowsOfView(const SceneRequest& request, std::size_t view);

void forEachView(const SceneRequest& request, auto&& act) {
  for (std::size_t v = 0; v < request.views.size(); ++v)
    for (const ViewOfPath& row : rowsOfView(request, v)) act(row);
}

// Its place among the rows.
std::size_t rowOf(const SceneRequest& request, const ViewOfPath& view);

// The view's name; behind it that of the path or pictures, which the first row of a view does not need.
std::string viewName(const SceneRequest& request, const ViewOfPath& view);

// What the names of each row's pictures begin with. sceneIndex: the scene's place in the run.
std::vector<std::string> prefixesOf(const SceneRequest& request, std::size_t sceneIndex);

} // namespace parity::job
