// The built-in scenes, one function each, and what they are put together with. Private to scenes/builtin/builtin*.cpp.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::scenes {

// Collects a scene part by part.
class SceneBuilder {
public:
  explicit SceneBuilder(std::string name) { m_scene.name = std::move(name); }

  // A texture slot that reads this image, repeating it `repeats` times over uv.
  TextureSlot texture(TextureImage image, float repeats = 1);
  // A mesh of a new material, not placed yet. Tangents are made where the material needs them.
  std::uint32_t addMesh(Mesh mesh, const Material& material);
  // Places one of the meshes, named `node`.
  void place(std::uint32_t mesh, const std::string& node, const glm::vec3& position, float turnDeg = 0,
             float scale = 1);
  // Both at once; the node is named after the material.
  void add(Mesh mesh, const Material& material, const glm::vec3& position, float turnDeg = 0, float scale = 1);
  void add(const Light& light) { m_scene.lights.push_back(light); }
  // The default camera: an orbit that fits the bounds, or one around a target, or `camera` itself.
  void setOrbitCamera(float thetaDeg, float phiDeg, float fovYDeg);
  void setOrbitCamera(float thetaDeg, float phiDeg, float radius, float fovYDeg, const glm::vec3& target);
  void setCamera(Camera camera);
  Scene finish(Environment environment);

private:
  Scene m_scene;
};

// A metal or dielectric of one colour (linear).
Material metal(std::string name, const glm::vec3& f0, float roughness);
Material plastic(std::string name, const glm::vec3& color, float roughness);

Scene makeRoomScene();      // a closed room with a window, for baked light
Scene makeCourtyardScene(); // a yard with columns and thin rods under a sun, for baked shadows
Scene makeSpheresScene();   // roughness steps of a metal and a dielectric, and a row for each feature
Scene makeLobesScene();     // coats, sheens, anisotropy, thin films and glass over roughness, and single cases
Scene makeFurnaceScene();   // F0 = 1 spheres in a white environment, orthographic
Scene makeLampsScene();     // a floor and objects under more lights than the mobile path takes
Scene makeLightsScene();    // a field of spheres under 1,000 coloured lamps
Scene makeShadowsScene();   // what shadow maps get wrong, under a sun, a lantern and a spot
Scene makeMaterialsScene(); // a still life of named materials

} // namespace parity::scenes
