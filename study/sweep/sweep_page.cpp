#include "study/sweep/sweep_page.h"

#include "report/dashboard_files.h"
#include "report/data_page.h"
#include "study/sweep/pareto_svg.h"

namespace parity::sweep {

std::string toPage(const SweepReport& report, const Conclusions& conclusions) {
  if (!report::hasDashboard()) return "";
  const std::string json = toJson(report, conclusions, base::JsonLayout::compact);
  const std::string plots = paretoJson(report, conclusions.against, conclusions.figure);
  return report::toHtml(
      report::DataPage{.tool = "parity bench",
                       .title = "Error against time",
                       .verdict = "",
                       .sub = report.machine.device,
                       .plain = "<p>This page needs JavaScript; bench.json holds all of its data.</p>\n",
                       .blocks = {{"bench", json}, {"bench-plots", plots}},
                       .files = {}});
}

} // namespace parity::sweep
