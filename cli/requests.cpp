#include "cli/requests.h"

#include <filesystem>

#include "scenes/names.h"

namespace parity::cli {

job::SceneRequest sceneRequest(const CommonOptions& common, const std::string& scene) {
  constexpr std::string_view kBuiltin = "builtin:";
  job::SceneRequest request;
  request.name = scenes::cleanName(scene.starts_with(kBuiltin) ? scene.substr(kBuiltin.size())
                                                               : std::filesystem::path(scene).stem().string());
  request.scene = scene;
  request.environment = common.environment;
  request.environmentRotationDeg = common.environmentRotationDeg;
  request.sun = common.sun;
  request.views = {common.view};
  return request;
}

} // namespace parity::cli
