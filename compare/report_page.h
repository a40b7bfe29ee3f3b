// index.html: what a reader sees at once, and the data that the dashboard (compare/dashboard) makes the rest of.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/report.h"

namespace parity::compare {

// A picture (.png) or pixel file (.js, compare/pixel_chunk.h) of a report, by its name in the report.
struct PageFile {
  std::string_view file;
  std::span<const std::byte> bytes;
};

struct PageRequest {
  std::string_view bench;      // JSON; empty: none
  bool singleFile = false;     // else dashboard.js, dashboard.css and all that the report names lie beside the page
  std::vector<PageFile> files; // that a single file holds
};

// UTF-8. Works from file:// and under a policy that forbids scripts in the page: it has none, only blocks of data; a
// single file's one script and one style are allowed by their hashes. Without scripts it shows the verdict and a table
// of what is over budget. All texts are escaped.
std::string toHtml(const Report& report, const RunInfo& run, const PageRequest& request = {});

} // namespace parity::compare
