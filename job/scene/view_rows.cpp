#include "job/scene/view_rows.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "external/transfer.h"
#include "job/paths.h"
#include "job/report_folder.h"

namespace parity::job {

namespace {

constexpr const char* kReference = "reference"; // of `replaces`

[[noreturn]] void refuse(const scenes::ExternalPictures& external, const char* key, const std::string& reason) {
  throw base::Error(base::ExitCode::usage, fmt::format("{}: {}", external.where, key), "", reason);
}

std::string known(const std::string& word, std::vector<std::string_view> names) {
  return fmt::format("'{}' is not known; {}", word, base::describeNearest(word, names));
}

} // namespace

std::vector<Column> columnsOf(const SceneRequest& request) {
  std::vector<Column> columns;
  for (const std::string& name : request.settings.pathNames) columns.push_back({name, nullptr, {}});
  for (const scenes::ExternalPictures& external : request.externals) {
    if (!external.reference.empty()) columns.push_back({external.name + " reference", &external, external.reference});
    columns.push_back({external.name, &external, external.test});
  }
  return columns;
}

void requireExternals(const SceneRequest& request) {
  const auto isReference = [](const scenes::ExternalPictures& each) { return each.replaces == kReference; };
  for (const scenes::ExternalPictures& each : request.externals) {
    if (!external::findTransfer(each.transfer))
      refuse(each, "transfer",
             known(each.transfer, {external::kTransferNames.begin(), external::kTransferNames.end()}));
    std::vector<std::string_view> paths(request.settings.pathNames.begin(), request.settings.pathNames.end());
    if (std::ranges::find(paths, each.name) != paths.end()) refuse(each, "name", "a path has this name");
    paths.front() = kReference;
    if (!each.replaces.empty() && std::ranges::find(paths, each.replaces) == paths.end())
      refuse(each, "replaces", known(each.replaces, paths));
  }
  if (std::ranges::count_if(request.externals, isReference) > 1)
    refuse(request.externals.back(), "replaces", "two externals of a scene replace the reference");
}

std::vector<ViewOfPath> rowsOfView(const SceneRequest& request, std::size_t view) {
  const std::vector<Column> columns = columnsOf(request);
  const std::size_t paths = request.settings.pathNames.size();
  const auto isReplaced = [&](const std::string& name) {
    return std::ranges::any_of(request.externals, [&](const auto& each) { return each.replaces == name; });
  };
  std::size_t reference = 0;
  for (std::size_t i = paths; i < columns.size(); ++i)
    if (columns[i].external->replaces == kReference) reference = i;
  std::vector<ViewOfPath> rows;
  for (std::size_t test = 1; test < paths; ++test)
    if (!isReplaced(columns[test].name)) rows.push_back({view, test, reference});
  for (std::size_t i = paths; i < columns.size(); ++i) {
    const bool isPair = !columns[i].external->reference.empty();
    if (i == reference) continue;
    if (isPair) ++i; // its own reference stands before it
    rows.push_back({view, i, isPair ? i - 1 : reference});
  }
  return rows;
}

std::size_t rowOf(const SceneRequest& request, const ViewOfPath& view) {
  const std::vector<ViewOfPath> rows = rowsOfView(request, view.view);
  return view.view * rows.size() + static_cast<std::size_t>(std::ranges::find(rows, view) - rows.begin());
}

std::string viewName(const SceneRequest& request, const ViewOfPath& view) {
  const std::string& name = request.views[view.view].name;
  const bool isFirst = rowsOfView(request, view.view).front() == view;
  return isFirst ? name : fmt::format("{} ({})", name, columnsOf(request)[view.test].name);
}

std::vector<std::string> prefixesOf(const SceneRequest& request, std::size_t sceneIndex) {
  std::vector<std::string> prefixes;
  forEachView(request, [&](const ViewOfPath& view) {
    prefixes.push_back(imagePrefix(sceneIndex, request.name, prefixes.size(), viewName(request, view)));
  });
  return prefixes;
}

} // namespace parity::job
