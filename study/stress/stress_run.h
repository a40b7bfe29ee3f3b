// parity stress: what is asked, what came out, and how it is told.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/text/json_writer.h"
#include "study/stress/function_stress.h"
#include "study/stress/render_stress.h"

namespace parity::stress {

struct Options {
  bool functions = true, renders = true;
  std::string functionGlob = "*", renderGlob = "*";
  FunctionOptions points;
  std::uint32_t scenes = 8; // random ones
  std::uint64_t seed = 1;   // of the first random scene; the following ones count on
  double seconds = 0;       // > 0: random scenes until so many have passed, in place of `scenes`
  RenderOptions render;
};

struct Report {
  std::string version, deviceName; // device: empty where none was opened
  std::string halfSkipped;         // why the device was not tried in half; empty where it was
  std::uint64_t seed = 0;
  std::vector<FunctionResult> functions;
  std::vector<SceneResult> scenes;
  std::vector<Finding> findings; // of both, sorted: unexpected ones first
  double functionsMs = 0, rendersMs = 0;
  std::uint64_t points = 0, devicePoints = 0; // asked for a function
  std::string failure;                        // what ended it early, as a lost device; empty: nothing

  std::size_t unexpected() const;
};

// Told of what is being done, and how much of the whole that is.
using Progress = std::function<void(const std::string& what, double done)>;

// Throws Error: usage for a glob that nothing matches, exit 4 where no device can be opened or one is lost.
Report runStress(const Options& options, const Progress& progress);

// What --list prints: functions with their inputs and ranges, claims and expectations, then the scenes.
std::string formatList(const Options& options);

// The tables for a terminal: findings, the worst errors, scenes.
std::string formatReport(const Report& report);
// stress.json, and it as a page. The page is empty in a build without the dashboard.
std::string formatJson(const Report& report, base::JsonLayout layout = base::JsonLayout::indented);
std::string formatPage(const Report& report);

} // namespace parity::stress
