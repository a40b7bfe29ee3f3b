// A floor under a square, and what the mobile path makes of lights that cast shadows there.
#pragma once

#include "support/device.h"
#include "support/small_scenes.h"

#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/shadows/shadow_maps.h"
#include "gpu/surface/surface_pass.h"
#include "mobile/renderer.h"

namespace parity::mobile {

inline constexpr std::uint32_t kShadowedSide = 96; // pixels a side

struct Picture {
  std::vector<float> lit; // red, row by row from the top; 0 where there is nothing
  std::vector<std::string> notes;
  std::optional<std::size_t> mapCount; // where some light casts
};

class ShadowTest : public tests::DeviceTest {
protected:
  // A floor of 4 m in z = 0 under a square of 1 m in z = 1, seen from between the two, half a metre above the floor.
  Picture render(const std::vector<scenes::Light>& lights, const Options& options, std::uint32_t mapSize = 2048) {
    scenes::Scene scene;
    scene.name = "square";
    scene.meshes = {tests::makeQuad(0), tests::makeQuad(0)};
    scene.materials.resize(1);
    scene.materials[0].metallic = 0;
    scene.materials[0].doubleSided = true;
    scene.instances = {{0, glm::scale(glm::mat4(1.f), glm::vec3(2, 2, 1)), "floor"},
                       {1, glm::scale(tests::translation(0, 0, 1), glm::vec3(0.5f, 0.5f, 1)), "square"}};
    scenes::Camera camera = tests::makeFrontCamera(2, 0.5f, true);
    camera.zNear = 0.1f;
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kShadowedSide, kShadowedSide);
    const auto surface = std::move(pass.render(camera, {0, kShadowedSide}, glm::vec2(0.5f)).front());
    std::optional<gpu::ShadowMaps> maps;
    if (const auto casting = Renderer::needsShadowMaps(lights, options); !casting.empty())
      maps.emplace(device(), buffers, casting, gpu::ShadowOptions{.mapSize = mapSize});
    Inputs inputs;
    inputs.lights = lights;
    inputs.shadows = maps ? &*maps : nullptr;
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, options);
    const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
    Picture picture{std::vector<float>(kShadowedSide * kShadowedSide), renderer.notes(), std::nullopt};
    if (maps) picture.mapCount = maps->mapCount();
    for (std::size_t i = 0; i < surface.size(); ++i) picture.lit[surface.pixels[i]] = shaded.color[i].x;
    return picture;
  }
};

} // namespace parity::mobile
