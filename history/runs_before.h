// The runs of a report's suite before it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "history/subject.h"
#include "report/report.h"

namespace parity::history {

struct RunsBefore {
  std::string suite, branch;      // branch: of the suite's newest run
  std::vector<std::int64_t> runs; // whole ones of that branch, oldest first; empty: there is none
  std::vector<LaneSpan> lanes;    // up to the newest of them
};
// started: of the report's run (report::RunInfo): runs since then do not count, as it may have been added already.
RunsBefore runsBefore(const Database& index, const std::string& suite, const std::string& started);

// A row's name in a history.
struct RowName {
  std::string scene, view, material; // material and view: empty: the whole image, the scene
  int ordinal = 0;                   // as SubjectRef has it
  auto operator<=>(const RowName&) const = default;
};
// material null: the view's whole image.
RowName nameOf(const report::SceneResult& scene, const report::ViewResult& view,
               const report::MaterialResult* material);

} // namespace parity::history
