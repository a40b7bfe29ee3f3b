// Each kind of change makes its own part of a bake stale, and no other.
#include "bake/scene_hash.h"

#include <gtest/gtest.h>

#include <functional>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

using namespace tests;

struct Lit {
  scenes::Scene scene;
  BakeLights lights;
};

Lit makeLit() {
  Lit lit;
  addObject(lit.scene, square(1), matte("floor", 0.5f));
  addObject(lit.scene, square(2), matte("panel", 0.2f, 3), glm::translate(glm::mat4(1.f), glm::vec3(0, 2, 0)));
  scenes::Mesh& mesh = lit.scene.meshes[0];
  mesh.uv0.assign(mesh.positions.size(), glm::vec2(0.5f));
  mesh.uv1.assign(mesh.positions.size(), glm::vec2(0.25f));
  mesh.colors.assign(mesh.positions.size(), glm::vec4(1));
  lit.scene.images = {{"used", base::Image8(2, 2, 4, 100)}, {"unused", base::Image8(2, 2, 4, 100)}};
  lit.scene.materials[0].baseColorTexture.image = 0;
  scenes::Light sun = pointLight({}, {2, 2, 2});
  sun.kind = scenes::LightKind::directional;
  lit.lights = {{pointLight({0, 1, 0}, {1, 2, 3}), sun}, 1, evenSky({1, 2, 3})};
  return lit;
}

std::string changeBy(const std::function<void(Lit&)>& change) {
  const Lit before = makeLit();
  Lit after = makeLit();
  change(after);
  return describeChange(hashScene(before.scene, before.lights), hashScene(after.scene, after.lights));
}

void expectChange(const std::string& part, const std::vector<std::function<void(Lit&)>>& changes) {
  const std::string expected = part.empty() ? "" : "is stale: the " + part + " changed after the bake";
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_EQ(changeBy(changes[i]), expected) << "change " << i;
}

TEST(SceneHash, GeometryIsMeshesAndWhereTheyStand) {
  expectChange("geometry",
               {[](Lit& l) { l.scene.meshes[0].positions[1].y += 1e-6f; },
                [](Lit& l) { l.scene.meshes[0].normals[1].x += 1e-6f; }, [](Lit& l) { l.scene.meshes[0].uv0[0].x = 0; },
                [](Lit& l) { l.scene.meshes[0].uv1[0].x = 0; }, [](Lit& l) { l.scene.meshes[0].colors[0].x = 0; },
                [](Lit& l) { std::swap(l.scene.meshes[0].indices[0], l.scene.meshes[0].indices[1]); },
                [](Lit& l) { l.scene.meshes[0].material = 1; },
                [](Lit& l) { l.scene.instances[1].toWorld[3].x = 1e-6f; },
                [](Lit& l) { l.scene.instances[1].mesh = 0; }, [](Lit& l) { l.scene.instances.pop_back(); },
                [](Lit& l) { std::swap(l.scene.instances[0], l.scene.instances[1]); }});
}

TEST(SceneHash, MaterialsAreWhatReflectsEmitsAndCovers) {
  expectChange(
      "materials",
      {[](Lit& l) { l.scene.materials[0].baseColor.y = 0.49f; }, [](Lit& l) { l.scene.materials[0].metallic = 0.1f; },
       [](Lit& l) { l.scene.materials[0].roughness = 0.1f; }, [](Lit& l) { l.scene.materials[1].emissive.z = 4; },
       [](Lit& l) { l.scene.materials[0].doubleSided = true; },
       [](Lit& l) { l.scene.materials[0].alphaMode = scenes::AlphaMode::mask; },
       [](Lit& l) { l.scene.materials[0].alphaCutoff = 0.4f; }, [](Lit& l) { l.scene.materials[0].unlit = true; },
       [](Lit& l) { l.scene.materials[0].transmission = 0.6f; }, // it no longer casts shadows
       [](Lit& l) { l.scene.materials[0].baseColorTexture.image = 1; },
       [](Lit& l) { l.scene.materials[0].baseColorTexture.texCoord = 1; },
       [](Lit& l) { l.scene.materials[1].emissiveTexture.image = 0; },
       [](Lit& l) { l.scene.images[0].pixels.pixels[3] = 99; }});
}

TEST(SceneHash, LightsAreThoseAndWhichIsTheSun) {
  expectChange("lights",
               {[](Lit& l) { l.lights.lights[0].color.x = 2; }, [](Lit& l) { l.lights.lights[0].range = 9; },
                [](Lit& l) { l.lights.lights[0].position.x = 2; },
                [](Lit& l) { l.lights.lights[0].falloff = scenes::Falloff::ue4; },
                [](Lit& l) { l.lights.lights[0].falloffExponent = 2; },
                [](Lit& l) {
                  l.lights.lights[1].direction = {0, -1, 0};
                },
                [](Lit& l) { l.lights.lights[0].kind = scenes::LightKind::spot; },
                [](Lit& l) { l.lights.lights[0].outerConeAngle = 1; },
                [](Lit& l) { l.lights.lights[0].innerConeAngle = 0.1f; }, [](Lit& l) { l.lights.lights.pop_back(); },
                [](Lit& l) { l.lights.sun.reset(); }, [](Lit& l) { l.lights.sun = 0; }});
}

TEST(SceneHash, SkyIsItsRadianceAndHowItIsTurned) {
  expectChange(
      "environment",
      {[](Lit& l) { l.lights.environment.reset(); }, [](Lit& l) { l.lights.environment->rotationDeg = 1; },
       [](Lit& l) { l.lights.environment->radiance.pixels[5] = 0; },
       [](Lit& l) { std::swap(l.lights.environment->radiance.width, l.lights.environment->radiance.height); }});
}

TEST(SceneHash, NothingElseCounts) {
  expectChange(
      "",
      {[](Lit&) {}, [](Lit& l) { l.scene.name = "another"; }, [](Lit& l) { l.scene.meshes[0].name = "another"; },
       [](Lit& l) { l.scene.materials[0].name = "another"; }, [](Lit& l) { l.scene.instances[0].node = "another"; },
       [](Lit& l) { l.scene.materials[0].transmission = 0.4f; }, [](Lit& l) { l.lights.lights[0].name = "another"; },
       [](Lit& l) { l.lights.lights[0].specularScale = 0.5f; }, [](Lit& l) { l.lights.environment->name = "another"; },
       [](Lit& l) { l.scene.images[1].pixels.pixels[3] = 99; }});
}

TEST(SceneHash, AllThatHasChangedIsNamed) {
  EXPECT_EQ(changeBy([](Lit& l) {
              l.scene.meshes[0].positions[0].x = 9;
              l.scene.materials[0].metallic = 1;
              l.lights = {};
            }),
            "is stale: the geometry, materials, lights, environment changed after the bake");
}

} // namespace
} // namespace parity::bake
