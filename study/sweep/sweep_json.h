// A sweep as JSON, both ways, and as CSV.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/text/json_writer.h"
#include "study/sweep/pareto.h"
#include "study/sweep/ratios.h"
#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// Of bench.json. 2: errors against the truth have the key "truth"; those against the first path's default its name.
constexpr int kSweepSchema = 2;

// The key "machine" of an object that is being written.
void writeMachine(base::JsonWriter& json, const Machine& machine);

// What is drawn from a sweep.
struct Conclusions {
  Against against = Against::first; // what the errors below are taken against
  std::string firstPath;            // by its name; also the key of errors against its default
  std::string figure = "flip.mean";
  std::vector<std::string> notes;     // what limits the conclusions, in words
  std::vector<std::string> dominated; // everywhere
  std::optional<ErrorBudget> budget;
  struct Cheapest {
    std::string scene, path; // scene empty: in all of them
    std::optional<std::string> setting;
  };
  std::vector<Cheapest> cheapest;    // of a sweep with a budget
  std::vector<Purchase> purchases;   // best first
  std::optional<SweepRatios> ratios; // of a sweep that is held against an earlier one
};
Conclusions conclude(const SweepReport& report, const std::optional<ErrorBudget>& budget);

std::string toJson(const SweepReport& report, const Conclusions& conclusions,
                   base::JsonLayout layout = base::JsonLayout::indented);
// The measurements of an earlier sweep. Throws Error (exit 4) with the place of what is missing or malformed.
SweepReport readSweep(const std::filesystem::path& file);

// One line a setting, scene and region ("": everything covered); RFC 4180.
std::string toCsv(const SweepReport& report);

} // namespace parity::sweep
