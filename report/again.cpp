#include "report/again.h"

#include <fmt/format.h>

#include "base/text/shell_word.h"
#include "report/view_choice.h"

namespace parity::report {
namespace {

// The length keeps ("a", "bc") and ("ab", "c") apart.
std::string keyOf(const std::string& scene, std::string_view view) {
  return fmt::format("{} {}{}", scene.size(), scene, view);
}

} // namespace

AgainCommands::AgainCommands(const RunInfo& run) {
  m_commands.reserve(run.again.size());
  for (const AgainCommand& each : run.again) m_commands.emplace(keyOf(each.scene, each.view), &each);
}

const AgainCommand* AgainCommands::find(const std::string& scene, std::string_view view) const {
  const auto found = m_commands.find(keyOf(scene, view));
  return found == m_commands.end() ? nullptr : found->second;
}

std::string AgainCommands::of(const SceneResult& scene, const ViewResult& view, const MaterialResult* material) const {
  if (m_commands.empty()) return {};
  const AgainCommand* found = find(scene.name, view.name);
  // A view by a further path has that path's name behind its own.
  if (const std::string ofPath = fmt::format(" ({})", view.test); !found && view.name.ends_with(ofPath))
    found = find(scene.name, std::string_view(view.name).substr(0, view.name.size() - ofPath.size()));
  if (!found) return {};
  // The run's own --material stays: what else it shows is part of the picture.
  if (!material || material->name.empty() || found->command.find(" --material") != std::string::npos)
    return found->command;
  const std::string glob = globOf(material->name);
  return found->command + (glob.starts_with('-') ? " --material=" : " --material ") + base::shellWord(glob);
}

} // namespace parity::report
