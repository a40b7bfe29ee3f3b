// Scenes that lie at the edges: made in memory, small, each with what must come out of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/frame.h"
#include "scenes/scene.h"

namespace parity::stress {

// A path's picture of a scene, with its terms.
struct PathFrame {
  std::string path;   // "highend", "mobile ue4-2020 fp16"
  std::string preset; // empty: high-end
  bool half = false;
  base::Frame frame;
};

struct SceneFrames {
  std::vector<PathFrame> paths;
  std::vector<base::PixelList> coverage; // a list per material
};

struct StressScene {
  std::string name;
  std::string wants; // what must come out, in words
  scenes::Scene scene;
  scenes::Camera camera;
  std::vector<float> leastRoughness; // of each material, textures included
  std::string reproduce;             // arguments of parity stress
  // What must hold besides what holds of every scene; the texts of what does not. `twin`: the frames of the scene
  // below, null where there is none.
  std::function<std::vector<std::string>(const SceneFrames& frames, const SceneFrames* twin)> check;
  std::shared_ptr<const StressScene> twin; // another scene, to be held against this one
  // Whether karis2014 must fail here (its own formulas): what is expected and has vanished is a finding.
  bool karisMustFail = false;
};

// The list of docs/shading.md 8.
std::vector<StressScene> namedScenes();
std::vector<StressScene> surfaceScenes(); // materials, normals, tangents
std::vector<StressScene> lightScenes();   // lights and environments

// A scene of random materials, textures, transforms, lights and geometry, degenerate ones among them. The same for the
// same seed on every machine.
StressScene randomScene(std::uint64_t seed);

} // namespace parity::stress
