#include "bake/scene_hash.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.h"
#include "base/member_count.h"
#include "lighting/surface/surface_hash.h"

namespace parity::bake {

namespace {

// Not in the keys: names; the scale of specular light, which is not baked; the panorama's height, which its width and
// pixels give.
static_assert(base::memberCount<scenes::Light>() == 11 && base::memberCount<scenes::Environment>() == 3 &&
                  base::memberCount<BakeLights>() == 3,
              "a new member goes into the key, or is named here with the reason why not");

template <typename T> void addAll(base::Hasher& hasher, const std::vector<T>& list) {
  hasher.addValue(list.size()).add(std::as_bytes(std::span{list}));
}

std::string hashLights(const BakeLights& lights) {
  base::Hasher hasher;
  hasher.addValue(lights.lights.size()).addValue(lights.sun.value_or(lights.lights.size()));
  for (const scenes::Light& light : lights.lights)
    hasher.addValue(light.kind)
        .addValue(light.color)
        .addValue(light.position)
        .addValue(light.direction)
        .addValue(light.range)
        .addValue(light.falloff)
        .addValue(light.falloffExponent)
        .addValue(light.innerConeAngle)
        .addValue(light.outerConeAngle);
  return hasher.hex();
}

std::string hashSky(const BakeLights& lights) {
  base::Hasher hasher;
  hasher.addValue(lights.environment.has_value());
  if (lights.environment) {
    hasher.addValue(lights.environment->rotationDeg).addValue(lights.environment->radiance.width);
    addAll(hasher, lights.environment->radiance.pixels);
  }
  return hasher.hex();
}

} // namespace

SceneHashes hashScene(const scenes::Scene& scene, const BakeLights& lights) {
  return {lighting::hashOfGeometry(scene), lighting::hashOfMaterials(scene), hashLights(lights), hashSky(lights)};
}

std::string describeChange(const SceneHashes& baked, const SceneHashes& now) {
  std::vector<std::string> parts;
  if (baked.geometry != now.geometry) parts.emplace_back("geometry");
  if (baked.materials != now.materials) parts.emplace_back("materials");
  if (baked.lights != now.lights) parts.emplace_back("lights");
  if (baked.sky != now.sky) parts.emplace_back("environment");
  if (parts.empty()) return {};
  return fmt::format("is stale: the {} changed after the bake", fmt::join(parts, ", "));
}

} // namespace parity::bake
