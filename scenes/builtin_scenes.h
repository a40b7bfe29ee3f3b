// The built-in scenes, one function each, and what they are put together with. Private to scenes/builtin*.cpp.
#pragma once

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
  // Places a mesh of a new material. Tangents are made where the material has a normal map.
  void add(Mesh mesh, const Material& material, const glm::vec3& position, float turnDeg = 0, float scale = 1);
  void add(const Light& light) { m_scene.lights.push_back(light); }
  // The default camera: an orbit that fits the bounds, or `camera` itself.
  void setOrbitCamera(float thetaDeg, float phiDeg, float fovYDeg);
  void setCamera(Camera camera);
  Scene finish(Environment environment);

private:
  Scene m_scene;
};

// A metal or dielectric of one colour (linear).
Material metal(std::string name, const glm::vec3& f0, float roughness);
Material plastic(std::string name, const glm::vec3& color, float roughness);

Scene makeSpheresScene();   // roughness steps of a metal and a dielectric, and a row for each feature
Scene makeFurnaceScene();   // F0 = 1 spheres in a white environment, orthographic
Scene makeLampsScene();     // a floor and objects under more lights than the mobile path takes
Scene makeMaterialsScene(); // a still life of named materials

} // namespace parity::scenes
