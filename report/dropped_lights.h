// The lights that a path drops from a view's objects, and what each does in the picture of the path that it is held
// against.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace parity::report {

// Mean FLIP of the displayed reference picture in which the material alone lacks the light against that with all
// lights, over the material's pixels.
struct LightEffect {
  std::string material;
  double flip = 0;
};

struct DroppedLight {
  std::string name, kind;                // unique in the scene; "directional", "point" or "spot"
  std::size_t keptBy = 0, droppedBy = 0; // objects that the view shows
  std::vector<LightEffect> materials;    // of the objects that drop it; the most first
  double worst() const { return materials.empty() ? 0 : materials.front().flip; }
};

// Of a view.
struct DroppedLights {
  std::size_t lights = 0;             // that the path could have, dropped or not
  std::vector<DroppedLight> measured; // the most first
  std::vector<std::string>
      notMeasured; // names of those beyond the run's limit: of less estimated effect, the most first
  std::size_t count() const { return measured.size() + notMeasured.size(); }
};

// Puts the materials of each light, and the lights, in order of their effect; equal ones stay in the order they have.
void rankByEffect(DroppedLights& dropped);

// "mobile drops 5 of 9 lights; without 'lamp 3' the high-end picture of 'floor' changes by FLIP 0.043, 'wall' by
// 0.03 without 'lamp 1'; 2 more were not measured": of up to three lights the material that each changes the most.
// Paths by their names.
std::string describe(const DroppedLights& dropped, const std::string& reference, const std::string& test);

} // namespace parity::report
