#include "cli/output.h"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "report/dashboard_files.h"

namespace parity::cli {

job::Progress makeProgress(bool quiet) {
  if (quiet || !isatty(STDERR_FILENO)) return {};
  return [](const std::string& what, double done) {
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(std::lround(done * kWidth));
    std::string bar;
    for (int i = 0; i < kWidth; ++i) bar += i < filled ? "█" : "░";
    fmt::print(stderr, "\r\x1b[K{} {:3.0f} % {}", bar, done * 100, base::plainLine(what));
    if (done >= 1) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
  };
}

void printTimings(const std::vector<std::pair<std::string, double>>& timings) {
  for (const auto& [stage, timeMs] : timings) fmt::print(stderr, "{:>9.1f} ms  {}\n", timeMs, stage);
}

void printText(const std::string& text, base::Colors colors) {
  const std::string shown = base::shownText(text, colors);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size() && errno != EPIPE)
    throw base::fileError("stdout", "", "could not be written");
}

void printTable(const report::Report& report) {
  const bool color = isatty(STDOUT_FILENO) != 0;
  printText(report::toTable(report, color) + "\n", color ? base::Colors::ours : base::Colors::none);
}

void printCommands(const std::string& commands, bool stdoutTaken) {
  fmt::print(stdoutTaken ? stderr : stdout, "{}", commands);
}

std::string dumpJson(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void writeJson(const std::string& target, const std::string& text) {
  if (target != "-") return base::writeText(target, text);
  printText(base::shownStrings(text));
  if (std::fflush(stdout) != 0 && errno != EPIPE) throw base::fileError("stdout", "", "could not be written");
}

void writePage(const std::filesystem::path& folder, const std::string& html) {
  if (!html.empty()) base::writeText(folder / "index.html", html);
}

void printPage(const std::filesystem::path& folder, const char* data, const std::string& note) {
  if (report::hasDashboard())
    print("{}{}\n", (folder / "index.html").string(), note.empty() ? "" : fmt::format(" ({})", note));
  else
    print("{} (this build of parity has no page index.html)\n", (folder / data).string());
}

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

void printAnnotations(const std::string& annotate, const report::Report& report, bool stdoutTaken) {
  if (annotate == "github")
    printCommands(report::toGithubAnnotations(report, std::filesystem::current_path()), stdoutTaken);
}

} // namespace parity::cli
