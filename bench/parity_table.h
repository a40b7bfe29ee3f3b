// The figures of the mobile presets' closeness to the high-end path, and the document made of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace parity::bench {

inline constexpr std::array<const char*, 3> kPresets = {"karis2014", "ue4-2020", "refit"};
inline constexpr std::size_t kPresetCount = kPresets.size();

// One material in one scene under one environment.
struct MaterialFlip {
  std::string scene, material, environment;
  bool sun = false;        // of --sun, besides what the environment holds
  bool sunLeftOut = false; // there were two, and the path has one
  std::array<double, kPresetCount> flip{};
  std::array<std::uint64_t, kPresetCount> nonFinite{}; // pixels
};

// A path's shading of one scene: device time, and per pixel what is counted of its shaders.
struct PathFigures {
  double timeMs = 0, operations = 0, fetches = 0;
  std::uint64_t samplers = 0;
};
struct SceneCost {
  std::string scene;
  std::array<PathFigures, kPresetCount + 1> paths; // the last: the high-end path
};

struct ParityTable {
  std::size_t environments = 0;
  std::vector<MaterialFlip> materials;
  std::vector<SceneCost> costs;
};

double medianOf(std::vector<double> values);

// docs/mobile-parity.md: the summary, costs, the worst, and every material (mean over the environments).
std::string toMarkdown(const ParityTable& table);

} // namespace parity::bench
