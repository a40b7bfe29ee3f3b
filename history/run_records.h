// The records of a run file: JSON and its reader come from these rows (report/record/record.h).
#pragma once

#include <type_traits>

#include "history/run.h"
#include "report/record/report_records.h"

namespace parity::history {

// The version of a run file: raised when a reader of the old form could misread the new one.
inline constexpr int kRunFormat = 1;

} // namespace parity::history

namespace parity::report {

// A row is a line.
// clang-format off
template <> inline constexpr auto kRecord<history::PictureHashes> = record<history::PictureHashes>(
    "", "",
    field("reference", &history::PictureHashes::reference, "", {.read = true}),
    field("test", &history::PictureHashes::test, "", {.read = true}),
    field("flip", &history::PictureHashes::flip, "", {.read = true}));
template <> struct Emptiness<history::PictureHashes> {
  static bool isEmpty(const history::PictureHashes& hashes) {
    return hashes.reference.empty() && hashes.test.empty() && hashes.flip.empty();
  }
};

template <> inline constexpr auto kRecord<history::RowRecord> = record<history::RowRecord>(
    "", "",
    field("name", &history::RowRecord::name, "", {.read = true}),
    field("verdict", &history::RowRecord::verdict, "", {.read = true}),
    field("reason", &history::RowRecord::reason, "", {.read = true, .ifEmpty = IfEmpty::absent}),
    field("rule", &history::RowRecord::rule, "", {.read = true, .ifEmpty = IfEmpty::absent}),
    field("figures", &history::RowRecord::figures, "", {.read = true}),
    field("pictures", &history::RowRecord::pictures, "", {.read = true, .ifEmpty = IfEmpty::absent}));

template <> inline constexpr auto kRecord<history::ViewRecord> = record<history::ViewRecord>(
    "", "",
    field("name", &history::ViewRecord::name, "", {.read = true}),
    field("whole", &history::ViewRecord::whole, "", {.read = true}),
    field("materials", &history::ViewRecord::materials, "", {.read = true}));

template <> inline constexpr auto kRecord<history::SceneRecord> = record<history::SceneRecord>(
    "", "",
    field("name", &history::SceneRecord::name, "", {.read = true}),
    field("inputs", &history::SceneRecord::inputs, "", {.read = true}),
    field("verdict", &history::SceneRecord::verdict, "", {.read = true}),
    field("error", &history::SceneRecord::error, "", {.read = true, .ifEmpty = IfEmpty::absent}),
    field("cached", &history::SceneRecord::isCached, "", {.read = true}),
    field("wallS", &history::SceneRecord::wallS, "", {.read = true}),
    field("cpuS", &history::SceneRecord::cpuS, "", {.read = true}),
    field("machine", &history::SceneRecord::machine, "", {.read = true, .ifEmpty = IfEmpty::absent}),
    field("views", &history::SceneRecord::views, "", {.read = true}));

using RunFormat = std::integral_constant<int, history::kRunFormat>;
template <> inline constexpr auto kRecord<history::RunRecord> = record<history::RunRecord>(
    "", "",
    computed("history", [](const history::RunRecord&) { return RunFormat(); }),
    field("started", &history::RunRecord::started, "", {.read = true}),
    field("suite", &history::RunRecord::suite, "", {.read = true}),
    field("branch", &history::RunRecord::branch, "", {.read = true}),
    field("commit", &history::RunRecord::commit, "", {.read = true}),
    field("commitTime", &history::RunRecord::commitTime, "", {.read = true}),
    field("version", &history::RunRecord::version, "", {.read = true}),
    field("build", &history::RunRecord::build, "", {.read = true}),
    field("device", &history::RunRecord::device, "", {.read = true}),
    field("driver", &history::RunRecord::driver, "", {.read = true}),
    field("numerics", &history::RunRecord::numerics, "", {.read = true}),
    field("machine", &history::RunRecord::machine, "", {.read = true}),
    field("settings", &history::RunRecord::settings, "", {.read = true}),
    field("budgets", &history::RunRecord::budgets, "", {.read = true}),
    field("report", &history::RunRecord::report, "", {.read = true}),
    field("verdict", &history::RunRecord::verdict, "", {.read = true}),
    field("complete", &history::RunRecord::isComplete, "", {.read = true}),
    field("whole", &history::RunRecord::isWhole, "", {.read = true}),
    field("incidents", &history::RunRecord::incidents, "", {.read = true}),
    field("stages", &history::RunRecord::stages, "", {.read = true}),
    field("scenes", &history::RunRecord::scenes, "", {.read = true}));
// clang-format on

} // namespace parity::report
