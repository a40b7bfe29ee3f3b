// Cameras and the sun from what the user writes.
#include "scenes/view.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/nearest.h"

namespace parity::scenes {
namespace {

base::Error usageError(const std::string& option, const std::string& reason) {
  return base::Error(base::ExitCode::usage, option, "", reason);
}

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::array<glm::vec3, 8> cornersOf(const Bounds& bounds) {
  std::array<glm::vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = {(i & 1 ? bounds.upper : bounds.lower).x,
                                            (i & 2 ? bounds.upper : bounds.lower).y,
                                            (i & 4 ? bounds.upper : bounds.lower).z};
  return corners;
}

// Least distance from the target at which all corners lie within the frustum, and a margin of 4 %.
float fitDistance(const Bounds& bounds, const glm::vec3& target, const glm::mat3& axes, float tanY, float tanX) {
  float distance = 0;
  for (const glm::vec3& corner : cornersOf(bounds)) {
    const glm::vec3 p = (corner - target) * axes; // right, up, back
    distance = std::max({distance, p.z + std::abs(p.y) * 1.04f / tanY, p.z + std::abs(p.x) * 1.04f / tanX});
  }
  return distance;
}

// Planes around the bounds. A camera among them keeps a near plane of a thousandth of the depth.
void enclosePlanes(Camera& camera, const Bounds& bounds) {
  float nearest = std::numeric_limits<float>::infinity(), farthest = -nearest;
  for (const glm::vec3& corner : cornersOf(bounds)) {
    const float depth = -glm::dot(glm::vec3(camera.toWorld[2]), corner - glm::vec3(camera.toWorld[3]));
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const float size = std::max(bounds.radius(), 1e-6f);
  camera.zFar = std::max(farthest + 0.01f * size, 0.01f * size);
  camera.zNear = std::max(nearest - 0.01f * size, camera.zFar * 1e-3f);
}

Camera orbit(const Scene& scene, const ViewRequest& request, float aspect) {
  const glm::vec3 parameters = request.orbit.value_or(glm::vec3(30, 70, 0));
  if (!isFinite(parameters) || parameters.y < 0 || parameters.y > 180 || parameters.z < 0)
    throw usageError("--orbit", "THETA,PHI,RADIUS: finite numbers, PHI from 0 to 180, RADIUS at least 0");
  if (!(request.fovYDeg >= 1 && request.fovYDeg <= 170))
    throw usageError("--fov", fmt::format("{} is not from 1 to 170 degrees", request.fovYDeg));
  if (request.target && !isFinite(*request.target)) throw usageError("--target", "is not three finite numbers");

  const float theta = glm::radians(parameters.x), phi = glm::radians(parameters.y);
  const float st = std::sin(theta), ct = std::cos(theta), sp = std::sin(phi), cp = std::cos(phi);
  // From the target to the eye; the other axes are its derivatives, so straight up and down are no exception.
  const glm::vec3 back(sp * st, cp, sp * ct), up(-cp * st, sp, -cp * ct), right(ct, 0, -st);

  const Bounds bounds = scene.bounds();
  const glm::vec3 target = request.target.value_or(bounds.center());
  Camera camera;
  camera.name = request.name;
  camera.fovYDeg = request.fovYDeg;
  const float tanY = std::tan(0.5f * glm::radians(camera.fovYDeg));
  float radius = parameters.z;
  if (radius == 0) radius = fitDistance(bounds, target, glm::mat3(right, up, back), tanY, tanY * aspect);
  if (!(radius > 0)) radius = 1; // a scene without extent
  camera.toWorld =
      glm::mat4(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(back, 0), glm::vec4(target + radius * back, 1));
  enclosePlanes(camera, bounds);
  return camera;
}

std::size_t findCamera(const Scene& scene, const std::string& wanted) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == wanted) return i;
  std::size_t index = 0;
  const char* end = wanted.data() + wanted.size();
  const auto parsed = std::from_chars(wanted.data(), end, index);
  if (parsed.ec == std::errc{} && parsed.ptr == end && index < scene.cameras.size()) return index;
  std::vector<std::string_view> known = {"auto"};
  for (const Camera& camera : scene.cameras) known.push_back(camera.name);
  const std::string ask = base::askNearest(wanted, known);
  std::string list = "auto"; // with numbers, which are names, too
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) list += fmt::format(", '{}' ({})", scene.cameras[i].name, i);
  throw usageError("--camera", fmt::format("scene '{}' has no camera '{}'; {}known: {}", scene.name, wanted,
                                           ask.empty() ? "" : ask + "; ", list));
}

} // namespace

Camera makeCamera(const Scene& scene, const ViewRequest& request, float aspect) {
  if (!(aspect > 0) || !std::isfinite(aspect)) throw usageError("--size", "width and height must be at least 1");
  if (scene.triangleCount() == 0)
    throw base::fileError(scene.name, "", "the scene is empty, so the camera has no target");
  const bool isAutomatic = request.camera.empty() || request.camera == "auto";
  if (!isAutomatic && request.orbit) throw usageError("--camera", "cannot be combined with --orbit");
  if (!isAutomatic && request.target) throw usageError("--camera", "cannot be combined with --target");
  if (isAutomatic && (request.orbit || request.target || scene.defaultCamera < 0)) return orbit(scene, request, aspect);

  const std::size_t index =
      isAutomatic ? static_cast<std::size_t>(scene.defaultCamera) : findCamera(scene, request.camera);
  Camera camera = scene.cameras[index];
  const bool isDefault = static_cast<int>(index) == scene.defaultCamera;
  if (isDefault && aspect < 1) { // made for a square: a narrower image shows as much of the width
    camera.halfHeight /= aspect;
    camera.fovYDeg = 2 * glm::degrees(std::atan(std::tan(0.5f * glm::radians(camera.fovYDeg)) / aspect));
  }
  Camera enclosing = camera;
  enclosePlanes(enclosing, scene.bounds());
  if (isDefault) return enclosing;
  if (camera.zFar == 0) camera.zFar = std::max(enclosing.zFar, 2 * camera.zNear); // infinite in the file
  return camera;
}

Light makeSun(const SunRequest& sun) {
  if (!std::isfinite(sun.azimuthDeg) || !(std::abs(sun.elevationDeg) <= 90) || !(sun.lux >= 0) ||
      !std::isfinite(sun.lux))
    throw usageError("--sun", "AZIMUTH,ELEVATION,LUX: finite numbers, ELEVATION from -90 to 90, LUX at least 0");
  const float a = glm::radians(sun.azimuthDeg), e = glm::radians(sun.elevationDeg);
  const glm::vec3 towards(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
  Light light;
  light.name = "sun";
  light.kind = LightKind::directional;
  light.color = glm::vec3(sun.lux);
  light.direction = -glm::normalize(towards);
  return light;
}

} // namespace parity::scenes
