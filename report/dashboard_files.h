// The report page's script and style sheet, which the build has made of report/dashboard and embedded.
#pragma once

#include <string_view>

namespace parity::report {

struct DashboardFile {
  std::string_view text;   // fit to stand between <script> or <style> tags as it is
  std::string_view sha256; // of the text, 64 hexadecimal digits
};

// Both are empty in a build without the page (PARITY_DASHBOARD=OFF).
const DashboardFile& dashboardScript(); // dashboard.js, a classic script
const DashboardFile& dashboardStyle();  // dashboard.css

// Whether this build has the page.
inline bool hasDashboard() { return !dashboardScript().text.empty(); }

} // namespace parity::report
