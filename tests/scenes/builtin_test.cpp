// The built-in scenes hold what their names promise.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "scenes/builtin/builtin.h"
#include "scenes/builtin/shapes.h"
#include "scenes/load.h"
#include "scenes/texture_slots.h"
#include "scenes/view.h"

namespace parity::tests {
namespace {

using scenes::LightKind;
using scenes::Mesh;
using scenes::Scene;

void expectSound(const Mesh& mesh, const std::string& what) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << what;
  ASSERT_FALSE(mesh.indices.empty()) << what;
  for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.f, 1e-4f) << what;
  if (!mesh.tangents.empty()) {
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size()) << what;
  }
  double area = 0, wrong = 0;
  for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
    ASSERT_LT(mesh.indices[3 * t], mesh.positions.size());
    const glm::vec3 a = mesh.positions[mesh.indices[3 * t]], b = mesh.positions[mesh.indices[3 * t + 1]],
                    c = mesh.positions[mesh.indices[3 * t + 2]];
    const glm::vec3 normal = glm::cross(b - a, c - a);
    area += glm::length(normal);
    const glm::vec3 shading = mesh.normals[mesh.indices[3 * t]] + mesh.normals[mesh.indices[3 * t + 1]] +
                              mesh.normals[mesh.indices[3 * t + 2]];
    if (glm::dot(normal, shading) < 0) wrong += glm::length(normal);
  }
  EXPECT_LT(wrong, 1e-3 * area) << what << ": triangles wound against their normals";
}

TEST(Builtin, EveryNameLoadsWithCameraEnvironmentAndUniqueMaterials) {
  ASSERT_FALSE(scenes::builtinSceneNames().empty());
  for (const std::string& name : scenes::builtinSceneNames()) {
    const Scene scene = scenes::loadScene("builtin:" + name);
    EXPECT_EQ(scene.name, name);
    EXPECT_TRUE(scene.file.empty());
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.environment.has_value());
    ASSERT_GE(scene.defaultCamera, 0);
    ASSERT_LT(static_cast<std::size_t>(scene.defaultCamera), scene.cameras.size());
    std::set<std::string> names;
    for (const scenes::Material& material : scene.materials) {
      EXPECT_TRUE(names.insert(material.name).second) << material.name;
      for (const scenes::NamedSlot& each : scenes::kTextureSlots)
        EXPECT_LT((material.*each.slot).image, static_cast<int>(scene.images.size()));
    }
    for (const Mesh& mesh : scene.meshes) {
      expectSound(mesh, name + "/" + mesh.name);
      ASSERT_LT(mesh.material, scene.materials.size());
      const scenes::Material& material = scene.materials[mesh.material];
      EXPECT_EQ(mesh.tangents.empty(),
                !material.normalTexture.present() && !material.coatNormalTexture.present() && !material.hasAnisotropy())
          << mesh.name;
    }
  }
}

TEST(Builtin, IsTheSameEveryTime) {
  for (const std::string& name : scenes::builtinSceneNames()) {
    const Scene a = scenes::makeBuiltinScene(name), b = scenes::makeBuiltinScene(name);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
    ASSERT_EQ(a.images.size(), b.images.size());
    for (std::size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].pixels, b.images[i].pixels);
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) EXPECT_EQ(a.instances[i].toWorld, b.instances[i].toWorld);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
      EXPECT_EQ(a.lights[i].position, b.lights[i].position);
      EXPECT_EQ(a.lights[i].color, b.lights[i].color);
    }
  }
}

// Floors and the walls about them apart, which may leave the picture, and what is above the eye.
TEST(Builtin, DefaultCamerasShowEveryObjectWhole) {
  for (const std::string& name : scenes::builtinSceneNames())
    for (const float aspect : {1.f, 1.7f, 0.6f}) {
      const Scene scene = scenes::makeBuiltinScene(name);
      const scenes::Camera camera = scenes::makeCamera(scene, {}, aspect);
      const glm::mat4 toView = glm::inverse(camera.toWorld);
      const float tanY = std::tan(0.5f * glm::radians(camera.fovYDeg));
      for (const scenes::Instance& instance : scene.instances) {
        const std::string& node = instance.node;
        if (node.ends_with("floor")) continue;
        if ((name == "room" || name == "courtyard") && node.ends_with("wall")) continue;
        if (name == "room" && (node == "ceiling" || node.starts_with("panel"))) continue;
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
          const glm::vec3 v = glm::vec3(toView * instance.toWorld * glm::vec4(p, 1));
          const float half = camera.orthographic ? camera.halfHeight : -v.z * tanY;
          ASSERT_GT(-v.z, camera.zNear) << name;
          ASSERT_LT(-v.z, camera.zFar) << name;
          ASSERT_LE(std::abs(v.y), half) << name << " " << aspect;
          ASSERT_LE(std::abs(v.x), half * aspect * 1.0001f) << name << " " << aspect;
        }
      }
    }
}

TEST(Builtin, FurnaceHasWhiteMetalsOfElevenRoughnessesThatDoNotOverlap) {
  const Scene scene = scenes::makeBuiltinScene("furnace");
  ASSERT_EQ(scene.materials.size(), 11u);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_FLOAT_EQ(scene.materials[i].roughness, static_cast<float>(i) / 10.f);
    EXPECT_EQ(scene.materials[i].baseColor, glm::vec4(1));
    EXPECT_EQ(scene.materials[i].metallic, 1.f);
  }
  EXPECT_EQ(scene.materials[3].name, "roughness 0.3");
  EXPECT_TRUE(scene.cameras[0].orthographic);
  EXPECT_EQ(scene.environment->name, "white");
  EXPECT_TRUE(scene.lights.empty());
  for (std::size_t i = 0; i < 11; ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT(glm::length(glm::vec2(scene.instances[i].toWorld[3] - scene.instances[k].toWorld[3])), 0.9f);
}

TEST(Builtin, LampsHasMoreLocalLightsThanTheMobilePathTakesAndADirectionalOne) {
  const Scene scene = scenes::makeBuiltinScene("lamps");
  const auto count = [&](LightKind kind) {
    return std::count_if(scene.lights.begin(), scene.lights.end(), [&](const auto& l) { return l.kind == kind; });
  };
  EXPECT_GT(count(LightKind::point) + count(LightKind::spot), 4);
  EXPECT_GE(count(LightKind::spot), 1);
  EXPECT_EQ(count(LightKind::directional), 1);
  for (const scenes::Light& light : scene.lights) EXPECT_NEAR(glm::length(light.direction), 1.f, 1e-6f);
}

TEST(Builtin, SpheresShowEveryFeatureOnce) {
  const Scene scene = scenes::makeBuiltinScene("spheres");
  const auto any = [&](const auto& is) {
    return std::count_if(scene.materials.begin(), scene.materials.end(), is) == 1;
  };
  using scenes::Material;
  EXPECT_TRUE(any([](const Material& m) { return m.fullyRough; }));
  EXPECT_TRUE(any([](const Material& m) { return m.unlit; }));
  EXPECT_TRUE(any([](const Material& m) { return m.emissive != glm::vec3(0); }));
  EXPECT_TRUE(any([](const Material& m) { return m.alphaMode == scenes::AlphaMode::mask; }));
  EXPECT_TRUE(any([](const Material& m) { return m.specularColor != glm::vec3(1); }));
  EXPECT_TRUE(any([](const Material& m) { return m.ior != 1.5f; }));
  EXPECT_EQ(scene.materials.size(), 24u);
}

TEST(Builtin, LobesStepThroughTheRoughnessOfCoatsAndSheensAndShowEachOtherCaseOnce) {
  const Scene scene = scenes::makeBuiltinScene("lobes");
  using scenes::Material;
  ASSERT_EQ(scene.materials.size(), 60u);
  for (std::size_t i = 0; i < 6; ++i) {
    const float step = static_cast<float>(i) / 5.f;
    const Material &coat = scene.materials[i], &gold = scene.materials[6 + i];
    EXPECT_EQ(coat.coat, 1.f);
    EXPECT_FLOAT_EQ(coat.coatRoughness, step);
    EXPECT_EQ(gold.coat, 1.f);
    EXPECT_FLOAT_EQ(gold.roughness, step);
    EXPECT_EQ(gold.metallic, 1.f);
    for (const std::size_t row : {12, 18}) {
      EXPECT_FLOAT_EQ(scene.materials[row + i].sheenRoughness, step);
      EXPECT_TRUE(scene.materials[row + i].hasSheen() && !scene.materials[row + i].hasCoat());
    }
  }
  EXPECT_EQ(scene.materials[1].name, "coat 0.2");
  EXPECT_EQ(scene.materials[7].name, "coat on gold 0.2");
  EXPECT_EQ(scene.materials[13].name, "sheen 0.2");
  EXPECT_EQ(scene.materials[19].name, "sheen white 0.2");
  const auto once = [&](const auto& is) {
    return std::count_if(scene.materials.begin() + 24, scene.materials.begin() + 30, is) == 1;
  };
  EXPECT_TRUE(once([](const Material& m) { return m.coat == 0.5f; }));
  EXPECT_TRUE(once([](const Material& m) { return m.coatNormalTexture.present() && !m.normalTexture.present(); }));
  EXPECT_TRUE(once(
      [](const Material& m) { return m.hasCoat() && m.normalTexture.present() && !m.coatNormalTexture.present(); }));
  EXPECT_TRUE(once([](const Material& m) { return m.sheenColorTexture.present(); }));
  EXPECT_TRUE(once([](const Material& m) { return m.hasCoat() && m.hasSheen(); }));
  EXPECT_TRUE(once([](const Material& m) { return m.hasCoat() && m.emissive != glm::vec3(0); }));
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_TRUE(scene.materials[i].hasCoat() || scene.materials[i].hasSheen()) << scene.materials[i].name;
}

TEST(Builtin, LobesStepThroughThinGlassBodiesAndTranslucentThings) {
  const Scene scene = scenes::makeBuiltinScene("lobes");
  using scenes::Material;
  ASSERT_EQ(scene.materials.size(), 60u);
  for (std::size_t i = 0; i < 6; ++i) {
    const float step = static_cast<float>(i) / 5.f;
    const Material &wall = scene.materials[54 + i], &body = scene.materials[48 + i];
    EXPECT_TRUE(wall.hasTransmission() && !wall.hasVolume()) << wall.name;
    EXPECT_FLOAT_EQ(wall.roughness, step);
    EXPECT_TRUE(body.hasTransmission() && body.hasVolume()) << body.name;
    EXPECT_EQ(body.dispersion > 0, i == 5) << body.name;
    if (i < 5) {
      EXPECT_FLOAT_EQ(body.roughness, step);
    }
    EXPECT_FLOAT_EQ(body.thickness, 0.92f) << "the sphere's diameter";
    EXPECT_GT(body.absorption().x, 0);
  }
  for (std::size_t i = 42; i < 46; ++i)
    EXPECT_TRUE(scene.materials[i].hasDiffuseTransmission()) << scene.materials[i].name;
  EXPECT_TRUE(scene.materials[45].hasTransmission()) << "both ways";
  EXPECT_TRUE(scene.materials[46].transmissionTexture.present());
  EXPECT_TRUE(scene.materials[47].hasCoat() && scene.materials[47].hasTransmission());
}

TEST(Builtin, LobesStepThroughTheRoughnessOfBrushedSteelAndThinFilms) {
  const Scene scene = scenes::makeBuiltinScene("lobes");
  using scenes::Material;
  ASSERT_GE(scene.materials.size(), 42u);
  std::set<float> rotations;
  for (std::size_t i = 0; i < 5; ++i) {
    const float step = static_cast<float>(i) / 5.f;
    const Material &steel = scene.materials[30 + i], &film = scene.materials[36 + i];
    EXPECT_FLOAT_EQ(steel.roughness, step);
    EXPECT_EQ(steel.metallic, 1.f);
    EXPECT_EQ(steel.anisotropy, 0.8f);
    EXPECT_FALSE(steel.hasIridescence());
    rotations.insert(steel.anisotropyRotation);
    EXPECT_FLOAT_EQ(film.roughness, step);
    EXPECT_EQ(film.metallic, i % 2 == 1 ? 1.f : 0.f);
    EXPECT_EQ(film.iridescence, 1.f);
    EXPECT_FLOAT_EQ(film.iridescenceThicknessMax, 200 + 100 * static_cast<float>(i));
    EXPECT_FALSE(film.hasAnisotropy());
  }
  EXPECT_EQ(rotations.size(), 3u) << "none, an eighth and a quarter of a turn";
  EXPECT_EQ(scene.materials[31].name, "anisotropy 0.2");
  EXPECT_EQ(scene.materials[37].name, "film 0.2");
  const Material &wavy = scene.materials[35], &oil = scene.materials[41];
  EXPECT_TRUE(wavy.hasAnisotropy() && wavy.anisotropyTexture.present());
  EXPECT_TRUE(oil.hasIridescence() && oil.iridescenceThicknessTexture.present());
  EXPECT_EQ(oil.iridescenceThicknessMin, 200.f);
  EXPECT_EQ(oil.iridescenceThicknessMax, 700.f);
  const auto& texels = scene.images.at(static_cast<std::size_t>(wavy.anisotropyTexture.image)).pixels.pixels;
  for (std::size_t i = 0; i < texels.size(); i += 4) { // a direction everywhere, to one side of u
    const glm::vec2 direction = glm::vec2(texels[i], texels[i + 1]) / 127.5f - 1.f;
    EXPECT_NEAR(glm::length(direction), 1, 0.01);
    EXPECT_GT(direction.x, 0.7f);
  }
}

TEST(Shapes, SphereIsASphereToAThousandth) {
  const Mesh sphere = scenes::makeSphere(2, 128, 64);
  double area = 0;
  for (std::size_t t = 0; 3 * t < sphere.indices.size(); ++t) {
    const glm::dvec3 a = sphere.positions[sphere.indices[3 * t]], b = sphere.positions[sphere.indices[3 * t + 1]],
                     c = sphere.positions[sphere.indices[3 * t + 2]];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  EXPECT_NEAR(area / (16 * 3.14159265358979), 1, 1.2e-3); // 4 pi r^2
  for (std::size_t i = 0; i < sphere.positions.size(); ++i)
    EXPECT_NEAR(glm::length(sphere.positions[i] - 2.f * sphere.normals[i]), 0, 1e-6);
}

TEST(Shapes, RoundedBoxStaysWithinItsExtentAndTouchesIt) {
  const glm::dvec3 half(1, 0.5, 0.25);
  const Mesh box = scenes::makeRoundedBox(half, 0.1, 4);
  glm::vec3 upper(0);
  for (const glm::vec3& p : box.positions) upper = glm::max(upper, glm::abs(p));
  EXPECT_NEAR(glm::length(upper - glm::vec3(half)), 0, 1e-6);
  expectSound(box, "box");
}

} // namespace
} // namespace parity::tests
