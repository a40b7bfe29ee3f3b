#include "cli/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/terminal.h"
#include "report/csv.h"
#include "report/dashboard_files.h"

namespace parity::cli {

namespace {

// The reader has gone, as `head` and pagers do: that is no error. What is still to come goes nowhere.
void closeStdout() {
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
  std::clearerr(stdout);
}

// errno says why, after fwrite or fflush has failed.
void requireNoFault(bool isGood) {
  if (isGood) return;
  if (errno != EPIPE) throw base::fileError("stdout", "", "could not be written");
  closeStdout();
}

void writeStdout(const std::string& text) {
  errno = 0;
  requireNoFault(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

} // namespace

void finishStdout() {
  errno = 0;
  requireNoFault(std::fflush(stdout) == 0 && std::ferror(stdout) == 0);
}

void printTimings(const std::vector<std::pair<std::string, double>>& timings) {
  std::string lines;
  for (const auto& [stage, timeMs] : timings) lines += fmt::format("{:>9.1f} ms  {}\n", timeMs, stage);
  std::fputs(lines.c_str(), stderr);
}

void printText(const std::string& text, base::Colors colors) { writeStdout(base::shownText(text, colors)); }

void printTable(const report::Report& report, const report::RunInfo& run, bool allRows) {
  constexpr std::size_t kLeast = 60;
  const base::TerminalFacts terminal = base::readTerminal(STDOUT_FILENO);
  const bool color = base::usesColors(terminal);
  // Not a terminal: a row stays one line, which grep finds whole.
  const std::size_t columns = terminal.isTerminal ? std::max(terminal.columns, kLeast) : 0;
  const report::TableOptions options{.color = color, .columns = columns, .all = allRows};
  printText(report::toTable(report, run, options) + "\n", color ? base::Colors::ours : base::Colors::none);
}

void printCommands(const std::string& commands, bool stdoutTaken) {
  if (stdoutTaken)
    std::fwrite(commands.data(), 1, commands.size(), stderr);
  else
    writeStdout(commands);
}

std::string dumpJson(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void writeJson(const std::string& target, const std::string& text) {
  if (target != "-") return base::writeText(target, text);
  printText(base::shownStrings(text));
  finishStdout();
}

void writeCsv(const std::string& target, const report::Report& report) {
  if (target.empty()) return;
  const std::string csv = report::toCsv(report);
  if (target == "-")
    printText(csv);
  else
    base::writeText(target, csv);
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
