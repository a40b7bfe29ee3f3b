#include "report/again.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text/shell_word.h"
#include "report/view_choice.h"

namespace parity::report {

std::string againCommand(const RunInfo& run, const SceneResult& scene, const ViewResult& view,
                         const MaterialResult* material) {
  // A view by a further path has that path's name behind its own.
  const std::string ofPath = fmt::format(" ({})", view.test);
  const auto isOf = [&](const AgainCommand& each) {
    return each.scene == scene.name && (each.view == view.name || each.view + ofPath == view.name);
  };
  const auto found = std::ranges::find_if(run.again, isOf);
  if (found == run.again.end()) return {};
  // The run's own --material stays: what else it shows is part of the picture.
  if (!material || material->name.empty() || found->command.find(" --material") != std::string::npos)
    return found->command;
  const std::string glob = globOf(material->name);
  return found->command + (glob.starts_with('-') ? " --material=" : " --material ") + base::shellWord(glob);
}

} // namespace parity::report
