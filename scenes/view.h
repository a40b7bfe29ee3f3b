// Cameras and the sun from what the user writes.
#pragma once

#include <optional>
#include <string>

#include "scenes/scene.h"

namespace parity::scenes {

// Where to look from. At most one of camera and orbit is set; neither: the automatic camera.
struct ViewRequest {
  std::string name = "auto";
  std::string camera;              // a glTF camera's name or its index; "" or "auto": automatic
  std::optional<glm::vec3> orbit;  // theta (deg), phi (deg), radius (metres; 0: fits the bounds)
  std::optional<glm::vec3> target; // metres; default the centre of the bounds
  float fovYDeg = 45;
};

// The camera of a view (docs/design.md 8c): eye = target + r*(sin phi sin theta, cos phi, sin phi cos theta), +Y up.
// The automatic camera is the scene's own default where it names one (with its own field of view; a narrower image than
// 1:1 shows as much of the width), else orbit (30, 70) fitted to the corners of the bounds; a target makes it an orbit.
// Near and far planes enclose the bounds; a camera of a file keeps its own, but for an infinite far one. Throws Error
// (usage) naming the known cameras where `camera` is unknown, for numbers without meaning, and where a camera is given
// together with an orbit or a target; (exit 4) for an empty scene.
Camera makeCamera(const Scene& scene, const ViewRequest& request, float aspect);

// --sun AZIMUTH,ELEVATION,LUX: degrees; azimuth from +X towards +Z as in the environment's u; elevation above the
// horizon. Returns a white directional light of that illuminance on a surface facing it.
struct SunRequest {
  float azimuthDeg = 0, elevationDeg = 45, lux = 0;
};
Light makeSun(const SunRequest& sun);

} // namespace parity::scenes
