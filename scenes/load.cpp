// Where scenes come from: a file or a built-in name.
#include "scenes/load.h"

#include "scenes/builtin.h"
#include "scenes/load_gltf.h"

namespace parity::scenes {

Scene loadScene(const std::string& fileOrBuiltin) {
  constexpr std::string_view kBuiltin = "builtin:";
  if (fileOrBuiltin.starts_with(kBuiltin)) return makeBuiltinScene(fileOrBuiltin.substr(kBuiltin.size()));
  return loadGltf(fileOrBuiltin);
}

} // namespace parity::scenes
