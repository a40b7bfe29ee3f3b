// parity preset and parity study-preset: the user's own formulas.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/paths.h"
#include "paths/preset/preset_template.h"

namespace parity::cli {

int runPresetNewCommand(const PresetNewCommand& command) {
  for (const paths::Path* path : job::allPaths()) {
    const paths::PresetHost* const host = path->presetHost();
    if (!host || std::ranges::count(paths::presetTemplates(*host), command.from) == 0) continue;
    paths::writePresetTemplate(*host, command.from, command.folder);
    const std::string folder = command.folder.find('/') == std::string::npos ? "./" + command.folder : command.folder;
    print("{}: preset.toml and preset.glsl of {}\nuse it: --{} {}\n", command.folder, command.from, path->folderKnob(),
          folder);
  }
  return 0;
}

int runPresetFunctionsCommand() {
  std::string page;
  for (const paths::Path* path : job::allPaths())
    if (const paths::PresetHost* const host = path->presetHost())
      page += (page.empty() ? "" : "\n") + paths::describeFunctions(*host);
  print("{}", page);
  return 0;
}

int runStudyPresetCommand(const StudyPresetCommand& command) {
  const base::ThreadLimit threads(command.common.threads);
  const std::filesystem::path folder = command.folder;
  presets::StudyRequest request = command.request;
  request.plots = !command.folder.empty();
  requireSeparate({{"--json", command.common.json}, {"-o", folder / "study.json"}}, {{"--scene", request.scene}});
  job::Context context(command.common.settings);
  const std::vector<presets::PresetStudy> studies =
      presets::studyPresets(context, request, makeProgress(command.common.quiet));
  const std::string json = presets::toJson(studies, request);
  if (!command.common.json.empty()) writeJson(command.common.json, json);
  if (!command.folder.empty()) {
    for (std::size_t i = 0; i < studies.size(); ++i)
      if (studies[i].plot)
        base::writeImage8(folder / presets::plotFile(i), *studies[i].plot, {.channelNames = {}, .pngCompression = 6});
    base::writeText(folder / "study.json", json + "\n");
    base::writeText(folder / "index.html", presets::toPage(studies, request));
  }
  if (command.common.json != "-" && !command.common.quiet) {
    print("{}", presets::toText(studies));
    if (!command.folder.empty()) print("{}\n", (folder / "index.html").string());
  }
  bool failed = false, found = false;
  for (const presets::PresetStudy& study : studies) {
    if (!study.failure.empty()) base::logError(study.failure);
    failed |= !study.failure.empty();
    found |= presets::findingsOf(study) > 0;
  }
  if (command.common.timings) printTimings(context.timings().stages());
  return static_cast<int>(failed  ? base::ExitCode::failed
                          : found ? base::ExitCode::overBudget
                                  : base::ExitCode::withinBudget);
}

} // namespace parity::cli
