// What a report of many scenes takes: time, memory and bytes of each file, without rendering.
//   build/bench_report_size write FOLDER [SCENES [VIEWS [MATERIALS]]]   makes one up and writes it (10000 3 5)
//   build/bench_report_size read FOLDER                                 reads its report.json as a baseline is read
//   build/bench_report_size since FOLDER                                both: makes it up, and holds it against FOLDER
//   build/bench_report_size units FOLDER [SCENES [VIEWS [MATERIALS [PICTURES]]]]  a plan with its units
//   build/bench_report_size merge FOLDER                                merges them
// The peak of resident memory is that of the process so far. The page of the folder:
// node report/dashboard/bench/large_page.mjs FOLDER.
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "base/error.h"
#include "bench/synthetic_plan.h"
#include "bench/synthetic_report.h"
#include "job/report_folder.h"
#include "report/baseline.h"
#include "report/reader.h"

namespace parity::bench {
namespace {

namespace fs = std::filesystem;

double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024; // from kB
}

void measure(const char* what, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << fmt::format("{:32} {:7.2f} s, peak {:7.0f} MiB\n", what, time.count(), peakMebibytes()) << std::flush;
}

std::uintmax_t bytesIn(const fs::path& fileOrFolder) {
  if (fs::is_regular_file(fileOrFolder)) return fs::file_size(fileOrFolder);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(fileOrFolder)) bytes += entry.file_size();
  return bytes;
}

report::Report makeReport(const ReportSize& size) {
  report::Report report;
  measure("made", [&] { report = makeSyntheticReport(size); });
  std::cout << fmt::format("{} scenes, {} rows of materials, {} MiB of rows in memory\n", report.scenes.size(),
                           report::countVerdicts(report).total(), static_cast<int>(peakMebibytes()));
  return report;
}

void write(const fs::path& folder, const ReportSize& size) {
  const report::Report report = makeReport(size);
  const report::RunInfo run = makeSyntheticRun(size);
  const report::Bench none;
  measure("folder prepared", [&] { job::prepareReportFolder(folder, false); });
  measure("written", [&] { job::writeReport(folder, report, run, {.bench = none, .pictures = {}}); });
  std::string table;
  measure("table for a terminal", [&] { table = report::toTable(report, run, {}); });
  std::cout << fmt::format("table: {:.1f} MB\n", static_cast<double>(table.size()) / 1e6);
  for (const char* name : {"report.json", "junit.xml", "run.json", "index.html", "scenes"})
    if (fs::exists(folder / name))
      std::cout << fmt::format("{:12} {:8.1f} MB\n", name, static_cast<double>(bytesIn(folder / name)) / 1e6);
}

void read(const fs::path& folder) {
  report::Report report;
  measure("read", [&] { report = report::readReport(folder); });
  std::cout << fmt::format("{} scenes\n", report.scenes.size());
}

void compare(const fs::path& folder, const ReportSize& size) {
  report::Report before;
  measure("baseline read", [&] { before = report::readReport(folder); });
  report::Report report = makeReport(size);
  measure("held against the baseline", [&] {
    report::compareWithBaseline(report, before, {folder.string(), {}, false});
  });
}

// argument: a whole number above 0, or nothing of it is taken.
void take(const std::vector<std::string_view>& arguments, std::size_t place, int& value) {
  if (place >= arguments.size()) return;
  int given = 0;
  const std::string_view text = arguments[place];
  if (std::from_chars(text.data(), text.data() + text.size(), given).ec == std::errc() && given > 0) value = given;
}

} // namespace
} // namespace parity::bench

int main(int argc, char** argv) {
  using namespace parity;
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::cerr << "bench_report_size write|read|since|units|merge FOLDER [SCENES [VIEWS [MATERIALS [PICTURES]]]]\n";
    return 64;
  }
  bench::ReportSize size;
  bench::take(arguments, 2, size.scenes);
  bench::take(arguments, 3, size.views);
  bench::take(arguments, 4, size.materials);
  int pictures = 0; // of a scene
  bench::take(arguments, 5, pictures);
  try {
    if (arguments[0] == "read")
      bench::read(arguments[1]);
    else if (arguments[0] == "since")
      bench::compare(arguments[1], size);
    else if (arguments[0] == "units")
      bench::measure("units written", [&] { bench::writeSyntheticUnits(arguments[1], size, pictures); });
    else if (arguments[0] == "merge")
      bench::measure("merged", [&] { bench::mergeSyntheticUnits(arguments[1]); });
    else
      bench::write(arguments[1], size);
  } catch (const base::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
