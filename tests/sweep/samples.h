// Sweeps made up by hand.
#pragma once

#include "sweep/sweep_report.h"

namespace parity::sweep {

inline VariantResult makeVariant(const std::string& path, const std::string& name, double timeMs, double flip) {
  VariantResult v;
  v.path = path;
  v.name = name;
  v.knobs = {{"knob", name}};
  if (name != "default") v.knob = "knob";
  v.times.deviceMs = {timeMs * 0.99, timeMs, timeMs * 1.01};
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
