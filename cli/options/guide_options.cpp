// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/guide_options.h"

#include "cli/completion.h"
#include "cli/man_page.h"
#include "cli/options/option_parts.h"
#include "scenes/builtin/builtin.h"

namespace parity::cli {

namespace {

std::vector<std::string> builtins(std::vector<std::string> names) {
  for (std::string& name : names) name.insert(0, "builtin:");
  return names;
}

} // namespace

void addGuideOptions(CLI::App& app, RawGuideOptions& raw) {
  CLI::App& help = *app.add_subcommand("help", "Show the help of a command");
  CLI::App& completion =
      *app.add_subcommand("completion", "Print a script that completes the command line in bash, zsh or fish");
  CLI::App& man = *app.add_subcommand("man", "Print the manual page of a command, or write all pages");
  std::vector<std::string> commands;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(each->get_name());
  choose(help.add_option("command", raw.helpOf, "Command, such as report, or budget suggest"), commands)
      ->option_text("COMMAND ..."); // their list would be wider than a line
  choose(completion.add_option("shell", raw.shell, "Shell"), kShells)->required();
  choose(man.add_option("command", raw.manOf, "Command. Default: the program itself"), commands)
      ->option_text("COMMAND");
  man.add_option("-o,--output", raw.manFolder, "Write the pages of all commands to this folder")
      ->type_name(kFolder)
      ->group(kOutputGroup);
}

GuideCommand settleGuide(const CLI::App& app, const RawGuideOptions& raw) {
  const CommandText program = describeProgram(app);
  if (app.get_subcommand("completion")->parsed())
    return {.text = completionScript(raw.shell, {program,
                                                 {builtins(scenes::builtinSceneNames()), {"gltf", "glb"}},
                                                 {builtins(scenes::builtinEnvironmentNames()), {"hdr", "exr", "pfm"}}}),
            .files = {},
            .folder = {}};
  if (raw.manFolder.empty()) return {.text = manPage(program, raw.manOf), .files = {}, .folder = {}};
  if (!raw.manOf.empty()) throw CLI::ExcludesError("--output", "command");
  return {.text = {}, .files = manPages(program), .folder = raw.manFolder};
}

std::vector<std::string> expandHelp(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  std::vector<std::string> expanded(arguments.begin() + 1, arguments.end());
  expanded.emplace_back("--help");
  return expanded;
}

} // namespace parity::cli
