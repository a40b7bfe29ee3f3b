// parity worst: the view, sun and rotation of the environment under which a scene is worst.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "base/text/text.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/context.h"
#include "study/explain/worst.h"

namespace parity::cli {

namespace {

nlohmann::ordered_json toJson(const explain::WorstView& view) {
  nlohmann::ordered_json json = {{"material", view.material},
                                 {"flip", view.flip},
                                 {"pixels", view.pixels},
                                 {"orbit", {view.orbit.x, view.orbit.y, view.orbit.z}},
                                 {"envRotation", view.rotation}};
  if (view.sun) json["sun"] = {view.sun->x, view.sun->y};
  return json;
}

} // namespace

int runWorstCommand(const WorstCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  const job::SceneRequest request = sceneRequest(command.common, command.scene);
  requireSeparate({{"--json", command.common.json}}, inputFiles(command.common, {request}));
  job::Context context(request.settings);
  const explain::WorstResult result =
      explain::findWorst(context, request, command.options, makeProgress(command.common.quiet));
  if (!command.common.json.empty()) {
    nlohmann::ordered_json json = {{"format", 1}, {"commandLine", commandLine}, {"scene", result.scene}};
    json["pictures"] = result.pictures;
    json["given"] = {{"material", result.given.material}, {"flip", result.given.flip}};
    json["views"] = nlohmann::ordered_json::array();
    for (const explain::WorstView& view : result.views) json["views"].push_back(toJson(view));
    writeJson(command.common.json, dumpJson(json));
  }
  if (command.common.json != "-") {
    const explain::WorstView& worst = result.views.front();
    print("# {}: mean FLIP {:.3f} at {}x{}, {} pixels", base::plainLine(worst.material), worst.flip,
          request.settings.width, request.settings.height, worst.pixels);
    if (result.given.pixels > 0)
      print("; in the view that was given {:.3f} ({})", result.given.flip, base::plainLine(result.given.material));
    print("\n# of {} pictures of {} pixels a side\n{}", result.pictures, command.options.size,
          explain::toToml(worst, request));
  }
  if (command.common.timings) printTimings(context.timings().stages());
  return 0;
}

} // namespace parity::cli
