// What each stage of a run costs as pixels, triangles, lights, materials and textures grow.
#pragma once

#include <string>
#include <vector>

#include "job/settings.h"
#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// Medians, in ms.
struct StageTimes {
  double load = 0;             // the file, its textures decoded
  double upload = 0;           // to the device
  double surface = 0;          // rasterised and resolved
  std::vector<double> shade{}; // by each path of the settings: device time without compiling
  double compare = 0;          // display transform, FLIP and the other metrics, by material
  double report = 0;           // pictures written
};
// "load", "upload", "surface", "shade NAME" of each path, "compare", "report".
std::vector<std::string> stageNames(const std::vector<std::string>& paths);
// In that order.
std::vector<double> valuesOf(const StageTimes& times);

struct ScalingPoint {
  double n = 0; // of what grows
  StageTimes times;
};

struct ScalingSeries {
  std::string grows;               // "pixels", "triangles", "lights", "materials", "textures"
  std::string rest;                // what stays, in words
  std::vector<std::string> stages; // stageNames
  std::vector<ScalingPoint> points;
  std::vector<double> exponents; // of t = c n^k through the largest three, a stage each
};

struct ScalingOptions {
  std::vector<std::string> series; // globs over what grows; empty: all
  int rounds = 5;
  int steps = 5;  // points a series, at least 3, each with 4 times the last one's n
  int side = 256; // of the pictures, but where their size grows (from half of it) and for lights (half of it)
};

// Over generated scenes in a temporary folder. settings: device and paths. progress may be empty.
std::vector<ScalingSeries> measureScaling(const job::Settings& settings, const ScalingOptions& options,
                                          const job::Progress& progress);

// A table a series: n, the stages' times, and the exponents.
std::string toText(const std::vector<ScalingSeries>& series);
std::string toJson(const std::vector<ScalingSeries>& series, const Machine& machine);

} // namespace parity::sweep
