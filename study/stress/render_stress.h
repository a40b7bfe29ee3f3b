// Whole renders under stress: every path over scenes at the edges, twice, under the validation layers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu/device/device_report.h"
#include "study/stress/finding.h"
#include "study/stress/stress_scene.h"

namespace parity::stress {

struct RenderOptions {
  gpu::DeviceOptions device;
  int size = 64;                    // pixels a side
  std::vector<std::string> presets; // only these of the mobile path; empty: all
};

struct SceneResult {
  std::string name, wants;
  std::vector<std::string> paths; // that were rendered
  std::vector<Finding> findings;
  double timeMs = 0;
};

// Renders by every path, by those with sets of knobs (presets, precisions) by each of them; in half where the device
// has it. Holds a device for each.
class RenderStress {
public:
  explicit RenderStress(const RenderOptions& options);
  ~RenderStress();

  // Everything that goes wrong is a finding, messages of the validation layer among it; nothing is thrown but where no
  // device can be opened (Error, exit 4).
  SceneResult stress(const StressScene& scene);

  // Why half is left out; empty where it is not.
  const std::string& halfSkipped() const { return m_halfSkipped; }
  const std::string& deviceName() const { return m_deviceName; }

private:
  void openDevices();
  SceneFrames render(const StressScene& scene, std::vector<Finding>& findings);

  RenderOptions m_options;
  std::string m_halfSkipped, m_deviceName;
  struct Setup;
  std::vector<Setup> m_setups;
};

// What is wrong with frames of this scene: values that are not finite, terms that do not add up to the colour (1e-3
// relative, 4e-3 in half), and what the scene's own check says. Of preset karis2014 what its own formulas make not
// finite, where they do, is expected.
std::vector<Finding> checkFrames(const StressScene& scene, const SceneFrames& frames, const SceneFrames* twin);

// Where two renderings of one scene differ.
std::vector<Finding> checkSame(const StressScene& scene, const PathFrame& first, const PathFrame& second);

} // namespace parity::stress
