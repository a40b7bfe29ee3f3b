// Where scenes come from: a file or a built-in name.
#include "scenes/load.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "scenes/builtin/builtin.h"
#include "scenes/gltf/load_gltf.h"
#include "scenes/names.h"

namespace parity::scenes {

namespace {

Scene readScene(const std::string& fileOrBuiltin, const LoadOptions& options) {
  if (isBuiltin(fileOrBuiltin)) {
    for (const auto& [option, value] : {std::pair("--scene", &options.scene), std::pair("--variant", &options.variant),
                                        std::pair("--animation", &options.animation)})
      if (!value->empty() && !(value == &options.animation && *value == kNoAnimation))
        throw base::Error(base::ExitCode::usage, option, "",
                          fmt::format("'{}' is unknown: {} has none", cleanName(*value), fileOrBuiltin));
    return makeBuiltinScene(fileOrBuiltin.substr(kBuiltinPrefix.size()));
  }
  return loadGltf(fileOrBuiltin, options);
}

} // namespace

Scene loadScene(const std::string& fileOrBuiltin, const LoadOptions& options) {
  Scene scene = readScene(fileOrBuiltin, options);
  for (const SourceFile& file : scene.sources) base::logDetail(fmt::format("read {}", file.file.string()));
  base::logDetail(fmt::format("scene {}: {} triangles, {} instances of {} meshes, {} materials, {} images, {} lights",
                              fileOrBuiltin, scene.triangleCount(), scene.instances.size(), scene.meshes.size(),
                              scene.materials.size(), scene.images.size(), scene.lights.size()));
  return scene;
}

} // namespace parity::scenes
