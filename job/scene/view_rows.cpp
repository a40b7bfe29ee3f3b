#include "job/scene/view_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "external/encoding.h"
#include "job/paths.h"
#include "job/report_folder.h"
#include "job/scene/external_pictures.h"

namespace parity::job {

namespace {

constexpr const char* kReference = "reference"; // of `replaces`
// What else a view's planes are called (job/view/view_planes.cpp).
constexpr std::array<std::string_view, 4> kTaken = {"truth", "flip", "materialFlip", "material"};

[[noreturn]] void refuse(const scenes::ExternalPictures& external, const char* key, const std::string& reason) {
  throw base::Error(base::ExitCode::usage, fmt::format("{}: {}", external.where, key), "", reason);
}

std::string known(const std::string& word, std::vector<std::string_view> names) {
  return fmt::format("'{}' is not known; {}", word, base::describeNearest(word, names));
}

// Two views of one picture: their names differ only in what file names do not keep, or the pattern lacks {view}.
void requireOwnPictures(const SceneRequest& request, const scenes::ExternalPictures& external) {
  for (const auto& [key, pattern] : {std::pair("test", external.test), std::pair("reference", external.reference)}) {
    if (pattern.empty()) continue;
    std::map<std::string, std::string> views; // by file
    for (const scenes::ViewRequest& view : request.views) {
      const std::string file = pictureFileOf(pattern, request.name, view.name);
      if (const auto [other, isNew] = views.emplace(file, view.name); !isNew)
        refuse(external, key,
               fmt::format("the views '{}' and '{}' have the same picture, {}", other->second, view.name, file));
    }
  }
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
    std::vector<std::string_view> transfers(external::kTransferNames.begin(), external::kTransferNames.end());
    transfers.push_back(external::kFitted);
    if (std::ranges::find(transfers, each.transfer) == transfers.end())
      refuse(each, "transfer", known(each.transfer, transfers));
    if (each.transfer == external::kFitted && each.calibration.empty())
      refuse(each, "transfer", "'fitted' needs 'calibration', from whose picture the curve is read");
    std::vector<std::string_view> paths(request.settings.pathNames.begin(), request.settings.pathNames.end());
    if (std::ranges::find(paths, each.name) != paths.end()) refuse(each, "name", "a path has this name");
    if (std::ranges::find(kTaken, each.name) != kTaken.end())
      refuse(each, "name", "reports use this name for something else");
    const auto hasSame = [&](const Column& column) { return column.external != &each && column.name == each.name; };
    if (std::ranges::any_of(columnsOf(request), hasSame)) refuse(each, "name", "the reference of another one has it");
    requireOwnPictures(request, each);
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
