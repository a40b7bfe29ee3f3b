// parity plot: figures of the formulas, as pictures and numbers.
#include <filesystem>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "job/paths.h"
#include "scenes/load.h"
#include "study/plot/env_brdf_picture.h"
#include "study/plot/env_brdf_plot.h"

namespace parity::cli {

int runPlotCommand(const PlotCommand& command) {
  if (command.quiet) base::setLogLevel(base::LogLevel::quiet);
  const std::filesystem::path folder = command.folder;
  const std::filesystem::path picture = folder / "env-brdf.png", numbers = folder / "env-brdf.csv",
                              ofMaterials = folder / "env-brdf-materials.csv";
  requireSeparate({{"-o", picture}, {"-o", numbers}, {"-o", ofMaterials}}, {{"the scene", command.scene}});
  const base::ThreadLimit threads(command.threads);
  const plot::PlottedPair pair = plot::pairOf(job::pathsOf(command.settings).chosen, command.settings.options);
  base::logDetail(fmt::format("plot: {} against {}", pair.test.title, pair.reference.title));
  std::vector<plot::MaterialDeviation> materials;
  std::string name;
  if (!command.scene.empty()) {
    const scenes::Scene scene = scenes::loadScene(command.scene, command.settings.scene.load);
    for (const std::string& warning : scene.warnings) base::logWarning(warning);
    name = scene.name;
    materials = plot::deviationsOf(scene, pair);
    if (materials.empty()) base::logWarning(command.scene + ": no material is lit, so none is compared");
  }
  base::writeImage8(picture, plot::drawEnvBrdf(pair, materials, name), {.channelNames = {}, .pngCompression = 6});
  base::writeText(numbers, plot::envBrdfCsv(pair));
  if (!materials.empty()) base::writeText(ofMaterials, plot::materialsCsv(pair, materials));
  if (!command.quiet) print("{}\n{}\n", plot::describe(pair, materials), picture.string());
  return 0;
}

} // namespace parity::cli
