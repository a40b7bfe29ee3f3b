#include "report/scene_file.h"

#include <fmt/format.h>

namespace parity::report {
namespace {

// Without the line feed at its end.
std::string ownLine(std::string line) {
  line.pop_back();
  return line;
}

} // namespace

SceneFiles::SceneFiles(const Report& report, const RunInfo& run, const EarlierRuns* earlier)
    : m_scenes(report.scenes), m_earlier(earlier && earlier->knowsAny() ? earlier : nullptr) {
  for (const AgainCommand& each : run.again) m_again[each.scene].push_back(&each);
}

std::string SceneFiles::nameOf(std::size_t place) { return fmt::format("scenes/{}.js", place); }

std::string SceneFiles::object(std::size_t place) const {
  const SceneResult& scene = m_scenes[place];
  std::string again;
  if (const auto found = m_again.find(scene.name); found != m_again.end())
    for (const AgainCommand* each : found->second) again += (again.empty() ? "" : ",") + ownLine(toJson(*each));
  return fmt::format("{{\"file\":\"{}\",\"format\":1,\"scene\":{},\"again\":[{}]{}}}", nameOf(place),
                     ownLine(toJson(scene)), again,
                     m_earlier ? ",\"history\":" + m_earlier->trendsJson(scene) : std::string());
}

std::string SceneFiles::script(std::size_t place) const { return fmt::format("parityScene({});\n", object(place)); }

} // namespace parity::report
