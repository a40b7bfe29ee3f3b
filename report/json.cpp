// report.json (report/report.schema.json) and run.json: the rows of their records as JSON.
#include <utility>

#include "report/record/record_writer.h"
#include "report/record/report_records.h"
#include "report/report.h"

namespace parity::report {
namespace {

template <typename T> std::string written(const T& record, base::JsonLayout layout, bool isHead = false) {
  RecordWriter writer(layout, {}, isHead);
  writer.write(record);
  return writer.finish();
}

} // namespace

void writeJson(const Report& report, const base::TextSink& sink, base::JsonLayout layout) {
  RecordWriter writer(layout, sink);
  writer.write(report);
  writer.finish();
}

std::string toJson(const Report& report, base::JsonLayout layout) { return written(report, layout); }
std::string toJson(const RunInfo& run, base::JsonLayout layout) { return written(run, layout); }
std::string headJson(const Report& report) { return written(report, base::JsonLayout::compact, true); }
std::string headJson(const RunInfo& run) { return written(run, base::JsonLayout::compact, true); }
std::string toJson(const AgainCommand& command) { return written(command, base::JsonLayout::compact); }
std::string toJson(const SceneResult& scene) { return written(scene, base::JsonLayout::compact); }

} // namespace parity::report
