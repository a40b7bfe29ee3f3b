// Scenes of matte surfaces whose light is known in closed form.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/shapes.h"
#include "scenes/scene.h"

namespace parity::tests {

inline scenes::Material matte(const std::string& name, float albedo, float emitted = 0) {
  scenes::Material material;
  material.name = name;
  material.baseColor = glm::vec4(glm::vec3(albedo), 1);
  material.metallic = 0;
  material.emissive = glm::vec3(emitted);
  return material;
}

// Adds an object of a material of its own.
inline void addObject(scenes::Scene& scene, scenes::Mesh mesh, const scenes::Material& material,
                      const glm::mat4& toWorld = glm::mat4(1.f)) {
  mesh.material = static_cast<std::uint32_t>(scene.materials.size());
  mesh.name = material.name;
  scene.materials.push_back(material);
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), toWorld, material.name});
  scene.meshes.push_back(std::move(mesh));
}

// A square of this half side in y = 0 that faces up.
inline scenes::Mesh square(float half) { return scenes::makeFloor(half, 1, 1); }

// A box of this half side whose faces are seen from within.
inline scenes::Mesh insideOfBox(float half) {
  scenes::Mesh mesh;
  const scenes::Mesh face = square(half);
  const glm::mat4 down = glm::translate(glm::mat4(1.f), glm::vec3(0, -half, 0));
  for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)})
    for (const float degrees : {0.f, 90.f, 180.f, 270.f}) {
      if (axis.z > 0 && (degrees == 0 || degrees == 180)) continue;
      scenes::appendMesh(mesh, face, glm::rotate(glm::mat4(1.f), glm::radians(degrees), axis) * down);
    }
  return mesh;
}

inline scenes::Environment evenSky(const glm::vec3& radiance) {
  scenes::Environment sky;
  sky.name = "even";
  sky.radiance = base::Image(64, 32, 3);
  for (std::size_t i = 0; i < sky.radiance.pixels.size(); ++i)
    sky.radiance.pixels[i] = radiance[static_cast<int>(i % 3)];
  return sky;
}

inline scenes::Light pointLight(const glm::vec3& position, const glm::vec3& candela) {
  scenes::Light light;
  light.name = "lamp";
  light.position = position;
  light.color = candela;
  return light;
}

} // namespace parity::tests
