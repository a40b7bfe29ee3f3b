#include "job/scene/view_rows.h"

#include <fmt/format.h>

#include "job/report_folder.h"

namespace parity::job {

std::size_t rowOf(const SceneRequest& request, const ViewOfPath& view) {
  return view.view * (request.settings.pathNames.size() - 1) + view.test - 1;
}

std::string viewName(const SceneRequest& request, const ViewOfPath& view) {
  const std::string& name = request.views[view.view].name;
  return view.test == 1 ? name : fmt::format("{} ({})", name, request.settings.pathNames[view.test]);
}

std::vector<std::string> prefixesOf(const SceneRequest& request, std::size_t sceneIndex) {
  std::vector<std::string> prefixes;
  forEachView(request, [&](const ViewOfPath& view) {
    prefixes.push_back(imagePrefix(sceneIndex, request.name, prefixes.size(), viewName(request, view)));
  });
  return prefixes;
}

} // namespace parity::job
