// What subcommands print: progress, timings, JSON to a file or stdout.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

#include "base/text/shown_text.h"
#include "job/settings.h"
#include "report/report.h"

namespace parity::cli {

// A bar on stderr where that is a terminal and nobody asked for quiet; else nothing. Erases itself at 1.
job::Progress makeProgress(bool quiet);

// Stage by stage, to stderr.
void printTimings(const std::vector<std::pair<std::string, double>>& timings);

// All that goes to stdout goes through here, but for GitHub's commands: base::shownText(). Throws Error (exit 4),
// except where the reader has gone, as a pager does.
void printText(const std::string& text, base::Colors colors = base::Colors::none);
template <typename... Parts> void print(fmt::format_string<Parts...> format, Parts&&... parts) {
  printText(fmt::format(format, std::forward<Parts>(parts)...));
}

// report::toTable(), in colours where stdout is a terminal.
void printTable(const report::Report& report);

// Indented, with a line feed behind it. What is no UTF-8 becomes U+FFFD.
std::string dumpJson(const nlohmann::ordered_json& json);

// Writes JSON to stdout for "-" (base::shownStrings()), else to the file. Throws Error (exit 4).
void writeJson(const std::string& target, const std::string& text);

// index.html; nothing where the build has no page and `html` is empty. Throws Error (exit 4).
void writePage(const std::filesystem::path& folder, const std::string& html);
// To stdout: where it is, or where that file with the same data is, and why.
// note: on the same line, in brackets; empty: none.
void printPage(const std::filesystem::path& folder, const char* data, const std::string& note = {});

// The extension in lower case, with its dot: as base::writeImage chooses the format.
std::string extensionOf(const std::string& file);

// Commands of GitHub Actions, each part of which is escaped already: to stdout, or to stderr where stdout is taken by
// JSON or CSV (GitHub reads either).
void printCommands(const std::string& commands, bool stdoutTaken);
// Those of a report, where `annotate` is "github".
void printAnnotations(const std::string& annotate, const report::Report& report, bool stdoutTaken);

} // namespace parity::cli
