// Sweeps made up by hand.
#pragma once

#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// Nine rounds, within a percent.
inline std::vector<double> aboutMs(double medianMs) {
  std::vector<double> times;
  for (int i = -4; i <= 4; ++i) times.push_back(medianMs * (1 + 0.0025 * i));
  return times;
}

inline VariantResult makeVariant(const std::string& path, const std::string& name, double timeMs, double flip) {
  VariantResult v;
  v.path = path;
  v.name = name;
  v.knobs = {{"knob", name}};
  if (name != "default") v.knob = "knob";
  v.times.deviceMs = aboutMs(timeMs);
  v.times.wallMs = v.times.cpuMs = v.times.deviceMs;
  v.times.compileMs = 40;
  v.cost = {100, 2.5, 3};
  v.whole = {"", 10, Errors{flip, 2 * flip, flip * flip, 0}, Errors{flip / 2, flip, flip, 1}};
  v.materials = {{"brass, \"old\"", 4, Errors{flip, flip, flip, 0}, Errors{flip, flip, flip, 0}}};
  return v;
}

inline SceneSweep makeSceneSweep(const std::string& name, std::vector<VariantResult> variants) {
  SceneSweep scene;
  scene.scene = name;
  scene.environment = "studio";
  scene.sun = "none";
  scene.width = scene.height = 64;
  scene.pixels = 1000;
  scene.truthError = 0.01;
  scene.variants = std::move(variants);
  scene.skipped = {"mobile sun: no directional light"};
  return scene;
}

} // namespace parity::sweep
