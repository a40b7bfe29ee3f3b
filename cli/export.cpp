// parity export: a scene as one binary glTF file.
#include <algorithm>

#include <fmt/format.h>

#include "base/file.h"
#include "base/log.h"
#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "scenes/builtin/builtin.h"
#include "scenes/gltf/export_glb.h"
#include "scenes/load.h"
#include "scenes/names.h"

namespace parity::cli {

namespace {

// What the file lacks of a scene's light, in a line, and what gives it back.
void tellEnvironment(const scenes::Environment& environment) {
  const std::vector<std::string> known = scenes::builtinEnvironmentNames();
  const bool isKnown = std::ranges::count(known, environment.name) > 0;
  base::logInfo(fmt::format(
      "the environment '{}' is not part of glTF, so the file lacks it{}", environment.name,
      isKnown ? fmt::format("; --env {}{} gives it to the scene again", scenes::kBuiltinPrefix, environment.name)
              : ""));
}

} // namespace

int runExportCommand(const ExportCommand& command) {
  scenes::LoadOptions options = command.common.settings.scene.load;
  options.allMaterials = true; // the file has the textures of all
  const scenes::Scene scene = scenes::loadScene(command.scene, options);
  for (const std::string& warning : scene.warnings) base::logWarning(warning);
  if (scene.triangleCount() == 0) throw base::fileError(command.scene, "", "the scene is empty: it has no triangle");
  std::vector<NamedFile> inputs;
  for (const scenes::SourceFile& source : scene.sources) inputs.push_back({"a file of the scene", source.file});
  requireSeparate({{"-o", command.output}}, inputs);

  const std::vector<std::byte> bytes = scenes::toGlb(scene);
  for (const std::string& line : scenes::listNotInGltf(scene)) base::logWarning(line);
  base::writeBytes(command.output, bytes);
  if (scene.environment) tellEnvironment(*scene.environment);
  return 0;
}

} // namespace parity::cli
