// index.html of a stress run: the dashboard with stress.json and the times as its data.
#include <fmt/format.h>

#include "report/dashboard_files.h"
#include "report/data_page.h"
#include "study/stress/stress_run.h"

namespace parity::stress {

std::string formatPage(const Report& report) {
  if (!report::hasDashboard()) return "";
  const std::size_t unexpected = report.unexpected();
  const std::string json = formatJson(report, base::JsonLayout::compact);
  base::JsonWriter times(base::JsonLayout::compact); // which stress.json does not have: it is the same for the same run
  times.beginObject();
  times.key("functionsMs").number(report.functionsMs);
  times.key("rendersMs").number(report.rendersMs);
  times.endObject();
  const std::string timesJson = times.finish();
  return report::toHtml(report::DataPage{
      .tool = "parity stress",
      .title = fmt::format("{} unexpected, {} expected findings", unexpected, report.findings.size() - unexpected),
      .verdict = unexpected > 0 ? "fail" : "pass",
      .sub = report.deviceName,
      .plain = "<p>This page needs JavaScript; stress.json holds all of its data.</p>\n",
      .blocks = {{"stress", json}, {"stress-times", timesJson}},
      .files = {}});
}

} // namespace parity::stress
