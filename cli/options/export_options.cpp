// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/export_options.h"

#include "cli/options/option_parts.h"

namespace parity::cli {

void addExportOptions(CLI::App& app, ExportCommand& command) {
  app.add_option("scene", command.scene, "Scene file or builtin:NAME")->required()->type_name(kSceneFile);
  app.add_option("-o,--output", command.output, "File to write: .glb")
      ->required()
      ->check(fileOfKind({".glb"}))
      ->type_name(kFile)
      ->group(kOutputGroup);
}

} // namespace parity::cli
