// A floor under a square, and what lights with and without shadow maps make of it.
#pragma once

#include "support/device.h"
#include "support/small_scenes.h"

#include <optional>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/shadows/shadow_maps.h"
#include "gpu/surface/surface_pass.h"
#include "highend/renderer.h"

namespace parity::highend {
using scenes::LightKind;
inline constexpr std::uint32_t kShadowedSide = 128;
inline constexpr float kFloor = 2; // half its side

inline scenes::Light makeLight(LightKind kind) {
  scenes::Light light;
  light.kind = kind;
  light.color = glm::vec3(3);
  light.position = {0, 0, 3};
  light.direction = {0, 0, -1};
  light.outerConeAngle = glm::radians(50.f);
  light.innerConeAngle = glm::radians(49.f);
  return light;
}

// A floor in z = 0, and a square of 1 m at z = 1, seen from below the square: by a camera that looks along the floor's
// normal, its near plane under the square.
struct Square {
  scenes::Scene scene;
  scenes::Camera camera = tests::makeFrontCamera(kFloor, 0.5f, true);
  Square() {
    scene.name = "square";
    scene.meshes = {tests::makeQuad(0), tests::makeQuad(1)};
    scene.materials.resize(2);
    scene.materials[0].doubleSided = scene.materials[1].doubleSided = true;
    scene.materials[0].metallic = 0;
    scene.instances = {{0, glm::scale(glm::mat4(1.f), glm::vec3(kFloor, kFloor, 1)), "floor"},
                       {1, glm::scale(tests::translation(0.25f, 0, 1), glm::vec3(0.5f, 0.5f, 1)), "square"}};
    camera.zNear = 0.1f;
  }
};

class ShadowTest : public tests::DeviceTest {
protected:
  // The floor's radiance by local lights and suns, row by row from the top.
  std::vector<double> floor(const scenes::Scene& scene, const scenes::Camera& camera,
                            const std::vector<scenes::Light>& lights, bool shadows,
                            const gpu::ShadowOptions& options = {}, bool cull = true) {
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kShadowedSide, kShadowedSide);
    const auto surface = std::move(pass.render(camera, {0, kShadowedSide}, glm::vec2(0.5f)).front());
    std::optional<gpu::ShadowMaps> maps;
    if (shadows) maps.emplace(device(), buffers, lights, options);
    Inputs inputs;
    inputs.lights = lights;
    inputs.shadows = maps ? &*maps : nullptr;
    inputs.cullLights = cull;
    const Options plain{.model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none};
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, plain);
    m_shaded = renderer.shade(surface, camera);
    if (maps) m_mapCount = maps->mapCount();
    if (maps) m_drawCount = maps->drawCount();
    std::vector<double> picture(kShadowedSide * kShadowedSide, -1);
    for (std::size_t i = 0; i < surface.size(); ++i)
      if (surface.instances[i] == 0) picture[surface.pixels[i]] = m_shaded.color[i].x;
    return picture;
  }
  static glm::vec2 placeOf(std::size_t pixel) {
    const float x = static_cast<float>(pixel % kShadowedSide) + 0.5f,
                y = static_cast<float>(pixel / kShadowedSide) + 0.5f;
    return glm::vec2(x / kShadowedSide * 2 - 1, 1 - y / kShadowedSide * 2) * kFloor;
  }
  // inShadow of a place on the floor, given a margin in metres that the shadow is to be grown by.
  template <typename InShadow> void expectShadow(const scenes::Light& light, float texel, const InShadow& inShadow) {
    const Square s;
    const std::vector<double> open = floor(s.scene, s.camera, {light}, false),
                              shadowed = floor(s.scene, s.camera, {light}, true);
    int dark = 0, lit = 0;
    for (std::size_t p = 0; p < open.size(); ++p) {
      const glm::vec2 place = placeOf(p);
      if (open[p] <= 0) continue;
      if (inShadow(place, -2 * texel)) {
        EXPECT_EQ(shadowed[p], 0) << place.x << " " << place.y;
        ++dark;
      } else if (!inShadow(place, 2 * texel)) {
        EXPECT_EQ(shadowed[p], open[p]) << place.x << " " << place.y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 300);
    EXPECT_GT(lit, 3000);
    EXPECT_EQ(m_mapCount, 1u);
    EXPECT_EQ(m_drawCount, 1u) << "the square, not the floor";
  }

  gpu::ShadedSurface m_shaded;
  std::size_t m_mapCount = 0, m_drawCount = 0;
};

} // namespace parity::highend
