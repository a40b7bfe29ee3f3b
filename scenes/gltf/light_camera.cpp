// Lights (KHR_lights_punctual) and cameras of a glTF file.
#include "scenes/gltf/light_camera.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "scenes/names.h"

namespace parity::scenes {
namespace {

const tinygltf::Node& nodeOf(const GltfDocument& document, const PlacedNode& node) {
  return document.model.nodes[static_cast<std::size_t>(node.node)];
}

// The node's axes without scale; right-handed even where the transform mirrors. The -Z axis is exact. Nothing, and a
// warning, where its scale leaves it no direction: an animated scale of 0 is how things are hidden (glTF 2.0, 3.5.3).
std::optional<glm::dmat3> axesOf(const PlacedNode& node, const char* what, std::vector<std::string>& warnings) {
  const glm::dvec3 y = node.toWorld[1], z = node.toWorld[2];
  const glm::dvec3 x = glm::cross(y, z);
  if (!(glm::length(x) > 0) || !std::isfinite(glm::length(x))) {
    warnings.push_back(
        fmt::format("/nodes/{} '{}': ignored, its scale gives its {} no direction", node.node, node.path, what));
    return std::nullopt;
  }
  const glm::dvec3 back = glm::normalize(z), right = glm::normalize(x);
  return glm::dmat3(right, glm::cross(back, right), back);
}

// extras.falloffExponent: Unreal Engine 4's LightFalloffExponent, for lights without its inverse square.
void readFalloff(const GltfDocument& document, const tinygltf::Light& source, const std::string& place, Light& light,
                 std::vector<std::string>& warnings) {
  if (!source.extras.IsObject() || !source.extras.Has("falloffExponent")) return;
  const std::string key = place + "/extras/falloffExponent";
  const tinygltf::Value& value = source.extras.Get("falloffExponent");
  const double exponent = value.IsNumber() ? value.GetNumberAsDouble() : 0;
  if (!(exponent > 0 && exponent <= kMaxFalloffExponent))
    throw document.error(
        key, fmt::format("is not a number above 0, up to {}; omit it for the inverse square", kMaxFalloffExponent));
  if (light.kind == LightKind::directional) {
    warnings.push_back(fmt::format("{}: ignored, a directional light has no falloff", key));
    return;
  }
  if (!(light.range > 0)) throw document.error(key, "needs a finite range, at which the light ends");
  light.falloff = Falloff::exponent;
  light.falloffExponent = static_cast<float>(exponent);
}

} // namespace

std::optional<Light> readLight(const GltfDocument& document, const PlacedNode& node,
                               std::vector<std::string>& warnings) {
  const auto& extensions = nodeOf(document, node).extensions;
  const auto found = extensions.find("KHR_lights_punctual");
  if (found == extensions.end()) return std::nullopt;
  const int index = found->second.Get("light").GetNumberAsInt();
  const tinygltf::Light& source = document.model.lights[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);

  Light light;
  light.name = cleanName(source.name);
  if (light.name.empty()) light.name = fmt::format("light {}", index);
  if (source.type == "directional")
    light.kind = LightKind::directional;
  else if (source.type == "point")
    light.kind = LightKind::point;
  else if (source.type == "spot")
    light.kind = LightKind::spot;
  else
    throw document.error(place + "/type", fmt::format("'{}' is not a light", cleanName(source.type)));

  if (source.intensity < 0) throw document.error(place + "/intensity", "is negative");
  for (std::size_t i = 0; i < 3; ++i) {
    const double color = source.color.empty() ? 1.0 : source.color[i];
    if (color < 0) throw document.error(place + "/color", "is negative");
    light.color[static_cast<int>(i)] = static_cast<float>(color * source.intensity);
    if (!std::isfinite(light.color[static_cast<int>(i)]))
      throw document.error(place, "color times intensity is not a finite 32-bit number");
  }
  if (light.color == glm::vec3(0)) warnings.push_back(fmt::format("{}: light '{}' is black", place, light.name));
  light.range = light.kind == LightKind::directional ? 0.f : static_cast<float>(source.range);
  readFalloff(document, source, place, light, warnings);
  light.position = glm::vec3(node.toWorld[3]);
  if (light.kind != LightKind::point) {
    const auto axes = axesOf(node, "light", warnings);
    if (!axes) return std::nullopt;
    light.direction = glm::vec3(-(*axes)[2]);
  }
  if (light.kind == LightKind::spot) {
    light.innerConeAngle = static_cast<float>(source.spot.innerConeAngle);
    light.outerConeAngle = static_cast<float>(source.spot.outerConeAngle);
    constexpr float kHalfPi = glm::half_pi<float>();
    if (!(light.innerConeAngle >= 0 && light.innerConeAngle < light.outerConeAngle &&
          light.outerConeAngle <= kHalfPi + 1e-4f))
      throw document.error(place + "/spot", fmt::format("cone angles {} and {} must satisfy 0 <= inner < outer <= pi/2",
                                                        light.innerConeAngle, light.outerConeAngle));
    light.outerConeAngle = std::min(light.outerConeAngle, kHalfPi);
  }
  return light;
}

std::optional<Camera> readCamera(const GltfDocument& document, const PlacedNode& node,
                                 std::vector<std::string>& warnings) {
  const int index = nodeOf(document, node).camera;
  if (index < 0) return std::nullopt;
  const tinygltf::Camera& source = document.model.cameras[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("/cameras/{}", index);

  Camera camera;
  camera.name = cleanName(source.name);
  if (camera.name.empty()) camera.name = cleanName(nodeOf(document, node).name);
  const auto axes = axesOf(node, "camera", warnings);
  if (!axes) return std::nullopt;
  for (int i = 0; i < 3; ++i) camera.toWorld[i] = glm::vec4(glm::vec3((*axes)[i]), 0);
  camera.toWorld[3] = glm::vec4(glm::vec3(node.toWorld[3]), 1);
  double zNear = 0, zFar = 0;
  if (source.type == "orthographic") {
    camera.orthographic = true;
    camera.halfHeight = static_cast<float>(std::abs(source.orthographic.ymag));
    if (!(camera.halfHeight > 0)) throw document.error(place + "/orthographic/ymag", "is 0");
    zNear = source.orthographic.znear;
    zFar = source.orthographic.zfar;
    if (!(zNear >= 0 && zFar > zNear)) throw document.error(place + "/orthographic", "needs 0 <= znear < zfar");
  } else {
    if (!(source.perspective.yfov > 0 && source.perspective.yfov < glm::pi<double>()))
      throw document.error(place + "/perspective/yfov",
                           fmt::format("{} is not between 0 and pi", source.perspective.yfov));
    camera.fovYDeg = static_cast<float>(glm::degrees(source.perspective.yfov));
    zNear = source.perspective.znear;
    zFar = source.perspective.zfar; // 0: absent, that is infinite
    if (!(zNear > 0 && (zFar == 0 || zFar > zNear)))
      throw document.error(place + "/perspective", "needs 0 < znear < zfar");
  }
  camera.zNear = static_cast<float>(zNear);
  camera.zFar = static_cast<float>(zFar);
  return camera;
}

} // namespace parity::scenes
