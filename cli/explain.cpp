// parity explain: what would help each material, and what it would cost.
#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/text/error_words.h"
#include "base/text/text.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/run_budgets.h"
#include "study/explain/explain.h"
#include "study/explain/explain_text.h"

namespace parity::cli {

int runExplainCommand(const ExplainCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  const RunRequest run = viewRequests(command.common, withListed(command.scenes, "scene"), command.suite);
  requireSeparate({{"--json", command.common.json}}, inputFiles(command.common, run.scenes));
  const job::RunBudgets budgets(command.common.settings.budgets, run.suiteBudgets);
  job::Context context(run.settings);
  const job::Progress progress = makeProgress(command.common.quiet);
  std::vector<explain::SceneExplanation> scenes;
  bool failed = false;
  for (const job::SceneRequest& request : run.scenes) {
    try {
      scenes.push_back(explain::explainScene(context, request, {.switches = command.switches}, budgets.of(request),
                                             progressOfScene(progress, scenes.size(), run.scenes.size())));
    } catch (const std::exception& error) {
      // What was found so far is not lost; what is wrong with the command line, or with the only scene, is told as
      // such.
      const auto* known = dynamic_cast<const base::Error*>(&error);
      if (known && (run.scenes.size() == 1 || (known->code() == base::ExitCode::usage && scenes.empty()))) throw;
      failed = true;
      explain::SceneExplanation& scene = scenes.emplace_back();
      scene.scene = request.name;
      scene.failure = known ? known->what() : base::wordsOf(error);
      base::logError(request.name + ": " + scene.failure);
    }
  }
  const explain::TeamView team = explain::teamViewOf(scenes);
  if (!command.common.json.empty()) writeJson(command.common.json, explain::toJson(scenes, team, commandLine));
  if (command.common.json != "-") {
    for (const explain::SceneExplanation& scene : scenes) print("{}\n", explain::toText(scene, command.allMaterials));
    print("{}", explain::toText(team));
  }
  for (const explain::SceneExplanation& scene : scenes)
    base::logDetail(fmt::format("{}: {:.2f} s for the sets", scene.scene, scene.seconds));
  if (command.common.timings) printTimings(context.timings().stages());
  return static_cast<int>(failed ? base::ExitCode::failed : base::ExitCode::withinBudget);
}

} // namespace parity::cli
