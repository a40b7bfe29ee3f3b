// A page that the dashboard's script (report/dashboard) makes out of blocks of data: of a report, a sweep, a stress
// run.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/text_sink.h"

namespace parity::report {

// A picture (.png) or pixel file (.js, report/pixel_chunk.h) of a report, by its name in the report.
struct PageFile {
  std::string_view file;
  std::span<const std::byte> bytes;
};

struct DataBlock {
  const char* id; // that the script looks for
  std::string_view json;
};

// A file of JSON (.js, report/scene_file.h) by its name, made when its turn comes: many need not be held at once.
struct MadeFile {
  std::string file;
  std::function<std::string()> object;
};

struct DataPage {
  std::string tool, title, verdict, sub; // of the head that is seen at once; verdict: may be empty
  std::string plain;                     // markup, for readers without scripts
  std::vector<DataBlock> blocks;
  bool singleFile = true;          // else dashboard.js, dashboard.css and all that the data names lie beside the page
  std::vector<PageFile> files;     // that a single file holds
  std::vector<MadeFile> made = {}; // these, too
};

// UTF-8, piece by piece. Works from file:// and under a policy that forbids scripts in the page: it has none, only
// blocks of data; a single file's one script and one style are allowed by their hashes. All texts but `plain` are
// escaped.
void writeHtml(const DataPage& page, const base::TextSink& sink);
std::string toHtml(const DataPage& page);

} // namespace parity::report
