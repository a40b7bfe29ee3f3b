// Where scenes come from: a file or a built-in name.
#include "scenes/load.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scenes/builtin/builtin.h"
#include "scenes/gltf/load_gltf.h"
#include "scenes/names.h"

namespace parity::scenes {

Scene loadScene(const std::string& fileOrBuiltin, const LoadOptions& options) {
  constexpr std::string_view kBuiltin = "builtin:";
  if (fileOrBuiltin.starts_with(kBuiltin)) {
    for (const auto& [option, value] : {std::pair("--scene", &options.scene), std::pair("--variant", &options.variant),
                                        std::pair("--animation", &options.animation)})
      if (!value->empty() && !(value == &options.animation && *value == kNoAnimation))
        throw base::Error(base::ExitCode::usage, option, "",
                          fmt::format("'{}' is unknown: {} has none", cleanName(*value), fileOrBuiltin));
    return makeBuiltinScene(fileOrBuiltin.substr(kBuiltin.size()));
  }
  return loadGltf(fileOrBuiltin, options);
}

} // namespace parity::scenes
