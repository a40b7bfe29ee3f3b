// Lights and cameras of a scene into a glTF file.
#include "scenes/gltf/export_light_camera.h"

#include <algorithm>

#include <glm/gtc/constants.hpp>

#include "base/text/text.h"
#include "scenes/gltf/tangents.h"
#include "scenes/view.h"

namespace parity::scenes {

namespace {

constexpr const char* kLightsName = "KHR_lights_punctual";

const char* typeOf(LightKind kind) {
  return kind == LightKind::directional ? "directional" : kind == LightKind::point ? "point" : "spot";
}

// The extension wants a colour within [0, 1], so that the intensity is the largest channel.
tinygltf::Light describe(const Light& light) {
  tinygltf::Light out;
  out.name = base::cleanUtf8(light.name);
  out.type = typeOf(light.kind);
  const double intensity = std::max({light.color.x, light.color.y, light.color.z});
  out.intensity = intensity;
  for (int i = 0; i < 3; ++i) out.color.push_back(intensity > 0 ? light.color[i] / intensity : 1.0);
  if (light.kind != LightKind::directional) out.range = light.range; // 0: not written
  if (light.kind == LightKind::spot) {
    out.spot.innerConeAngle = light.innerConeAngle;
    out.spot.outerConeAngle = std::min<double>(light.outerConeAngle, glm::half_pi<double>()); // a float's is above
  }
  if (light.falloff == Falloff::exponent)
    out.extras = gltfObject({{"falloffExponent", tinygltf::Value(static_cast<double>(light.falloffExponent))}});
  return out;
}

tinygltf::Node nodeOf(const Light& light) {
  tinygltf::Node node;
  const glm::dvec3 at(light.position);
  if (light.kind == LightKind::point) {
    node.translation = {at.x, at.y, at.z};
    return node;
  }
  const glm::dvec3 back = -glm::normalize(glm::dvec3(light.direction)); // a light shines along its node's -Z
  const glm::dvec3 up = glm::normalize(glm::cross(back, glm::dvec3(perpendicularTo(glm::vec3(back)))));
  const glm::dvec3 right = glm::cross(up, back);
  node.matrix = gltfMatrix({glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(at, 1)});
  return node;
}

tinygltf::Camera describe(const Camera& camera) {
  tinygltf::Camera out;
  out.name = base::cleanUtf8(camera.name);
  out.type = camera.orthographic ? "orthographic" : "perspective";
  out.perspective.yfov = glm::radians(static_cast<double>(camera.fovYDeg));
  out.perspective.znear = out.orthographic.znear = camera.zNear;
  out.perspective.zfar = out.orthographic.zfar = camera.zFar;
  out.orthographic.xmag = out.orthographic.ymag = camera.halfHeight; // a square: scenes have no aspect
  return out;
}

} // namespace

void addLights(GlbDraft& draft, const Scene& scene) {
  for (const Light& light : scene.lights) {
    tinygltf::Node node = nodeOf(light);
    node.name = base::cleanUtf8(light.name);
    node.extensions[kLightsName] =
        gltfObject({{"light", tinygltf::Value(static_cast<int>(draft.model.lights.size()))}});
    draft.model.lights.push_back(describe(light));
    draft.addNode(std::move(node));
    draft.extensions.insert(kLightsName);
  }
}

void addCameras(GlbDraft& draft, const Scene& scene) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const bool isDefault = static_cast<int>(i) == scene.defaultCamera && scene.triangleCount() > 0;
    const Camera camera = isDefault ? makeCamera(scene, {}, 1.f) : scene.cameras[i];
    tinygltf::Node node;
    node.name = base::cleanUtf8(camera.name);
    node.camera = static_cast<int>(draft.model.cameras.size());
    node.matrix = gltfMatrix(camera.toWorld);
    draft.model.cameras.push_back(describe(camera));
    draft.addNode(std::move(node));
  }
}

} // namespace parity::scenes
