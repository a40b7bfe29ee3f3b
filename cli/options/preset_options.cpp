// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/preset_options.h"

#include "cli/options/option_parts.h"
#include "job/paths.h"
#include "paths/preset/preset_template.h"

namespace parity::cli {

void addPresetOptions(CLI::App& app, RawPresetOptions& raw) {
  app.require_subcommand(1);
  std::vector<std::string> templates;
  for (const paths::Path* path : job::allPaths())
    if (const paths::PresetHost* host = path->presetHost())
      for (const std::string& name : paths::presetTemplates(*host)) templates.push_back(name);
  CLI::App& made = *app.add_subcommand("new", "Write a preset folder to start from");
  made.add_option("folder", raw.made.folder, "Folder to write, new or empty")->type_name(kFolder)->required();
  choose(made.add_option("--from", raw.made.from, "Template with the first formulas"), templates)
      ->group(kInputGroup)
      ->capture_default_str();
  app.add_subcommand("functions", "Print the functions that a preset folder may define");
}

void addStudyPresetOptions(CLI::App& app, RawPresetOptions& raw) {
  StudyPresetCommand& study = raw.study;
  study.common.settings.width = study.common.settings.height = 256;
  app.add_option("presets", study.request.presets, "Preset folders, or names of presets")
      ->type_name("PRESET")
      ->required();
  app.add_option("--scene", study.request.scene, "Scene file or builtin:NAME to render with each preset")
      ->type_name(kSceneFile)
      ->group(kInputGroup)
      ->capture_default_str();
  app.add_option("-o,--output", study.folder, "Folder for the page, the plots and study.json. Default: none is written")
      ->type_name(kFolder)
      ->group(kOutputGroup);
  app.add_option("--json", study.common.json, "Write all figures to this file; - for stdout, instead of the text")
      ->type_name(kFile)
      ->group(kOutputGroup);
  std::vector<std::string> without = {"env", "precision", "costs", "paths"};
  for (const paths::Path* path : job::allPaths()) without.push_back(path->folderKnob()); // the presets themselves
  addKnobs(app, study.common, raw.common, {"Picture", "Paths"}, without);
  addEnvironments(app, raw.common);
  addRunOptions(app, study.common, raw.common);
}

Invocation settlePreset(const CLI::App& app, const RawPresetOptions& raw) {
  if (app.got_subcommand("new")) return raw.made;
  return PresetFunctionsCommand();
}

StudyPresetCommand settleStudyPreset(const CLI::App& app, const RawPresetOptions& raw) {
  StudyPresetCommand command = raw.study;
  settle(app, command.common, raw.common);
  requireSizeFits(command.common, kComparedPixelBytes);
  command.request.size = command.common.settings.width;
  command.common.settings.costs = true;
  command.request.plain = command.common.plain;
  command.request.plain.costs = true;
  command.request.given = command.common.given;
  command.request.environments = command.common.environments;
  if (command.request.environments.empty())
    for (const char* name : {"builtin:studio", "builtin:sky", "builtin:night"})
      command.request.environments.emplace_back(name);
  return command;
}

} // namespace parity::cli
