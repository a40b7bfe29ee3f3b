// report.json back as a Report, scene by scene: every value that is read is there and of its type, or the place of it
// is named.
#include "report/reader.h"

#include <exception>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "report/record/record_reader.h"
#include "report/record/report_records.h"
#include "report/streamed_json.h"
#include "report/trim.h"

namespace parity::report {
namespace {

using nlohmann::json;

// What stands in a list or in an optional; else the type itself.
template <typename T> struct Within { using Type = T; };
template <typename T> struct Within<std::vector<T>> { using Type = T; };
template <typename T> struct Within<std::optional<T>> { using Type = T; };

template <typename T> Wanted wantedOf(ReadDepth depth);
template <typename Owner, typename... Rows>
void addWanted(Wanted& wanted, const std::tuple<Rows...>& rows, ReadDepth depth) {
  forEachRow(rows, [&]<typename Row>(const Row& row) {
    if (!isRead(row, depth)) return;
    if constexpr (kIsGroup<Row>)
      addWanted<Owner>(wanted.keys[std::string(row.key)], row.rows, depth);
    else if constexpr (Readable<Owner, Row>)
      wanted.keys[std::string(row.key)] = wantedOf<typename Within<MemberType<Owner, Row>>::Type>(depth);
  });
}
// The keys that are read of a record; all of what is none.
template <typename T> Wanted wantedOf(ReadDepth depth) {
  Wanted wanted;
  if constexpr (Described<T> && !IsByName<T>)
    addWanted<T>(wanted, kRecord<T>.rows, depth);
  else
    wanted.all = true;
  return wanted;
}

} // namespace

std::filesystem::path reportFileOf(const std::filesystem::path& fileOrFolder) {
  std::error_code ignored;
  return std::filesystem::is_directory(fileOrFolder, ignored) ? fileOrFolder / "report.json" : fileOrFolder;
}

Report readReport(const std::filesystem::path& fileOrFolder, ReadDepth depth) {
  const std::filesystem::path path = reportFileOf(fileOrFolder);
  const std::string file = path.string();
  Wanted wanted = wantedOf<Report>(depth);
  wanted.keys["schema"].all = true;
  std::vector<SceneResult> scenes;
  std::exception_ptr fault; // of the first scene that has one: what is wrong with the report as a whole is said before
  const auto take = [&](const json& element, std::size_t index) {
    if (fault) return;
    try {
      readRecord(Node(element, file, fmt::format("/scenes/{}", index), depth), scenes.emplace_back());
      trim(scenes.back());
    } catch (const base::Error&) {
      fault = std::current_exception();
    }
  };
  const json document = readWanted(path, wanted, {"scenes", take}, "is not JSON, so it is not a report.json");
  const Node root(document, file, "", depth);
  const std::uint64_t schema = root.at("schema").count();
  if (schema < kOldestRead || schema > kReportSchema)
    root.at("schema").refuse(
        fmt::format("is {}, from {} version of parity; this one reads {} to {}; make the report again", schema,
                    schema > kReportSchema ? "a newer" : "an older", kOldestRead, kReportSchema));
  Report report;
  readRecord(root, report);
  if (fault) std::rethrow_exception(fault);
  report.scenes = std::move(scenes);
  return report;
}

RunInfo readRun(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "run.json";
  Wanted wanted = wantedOf<RunInfo>(ReadDepth::figures);
  wanted.keys["schema"].all = true;
  const json document = readWanted(path, wanted, {"", {}}, "is not JSON, so it is not a run.json");
  const Node root(document, path.string(), "");
  root.at("schema").count();
  RunInfo run;
  readRecord(root, run);
  return run;
}

} // namespace parity::report
