// Energy and finiteness of the high-end path over its whole material domain: a field of one-pixel quads, each with a
// material and a shading normal of its own.
#include "support/path_quad.h"

#include "highend/renderer.h"

namespace parity::highend {
namespace {

struct Patch {
  float angle, roughness, metallic;
  glm::vec3 baseColor;
  float specular = 1;
  float ior = 1.5f;
};

// In rows of `side` quads that fill the picture of -1 .. 1.
scenes::Scene makeField(const std::vector<Patch>& patches, int side) {
  scenes::Scene scene;
  scene.name = "field";
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& patch = patches[i];
    scenes::Mesh mesh = tests::makeQuad(static_cast<std::uint32_t>(i));
    const glm::vec3 center(2.f * static_cast<float>(static_cast<int>(i) % side) / side - 1 + 1.f / side,
                           1 - 2.f * static_cast<float>(static_cast<int>(i) / side) / side - 1.f / side, 0);
    for (glm::vec3& p : mesh.positions) p = center + p / static_cast<float>(side);
    mesh.normals.assign(4, {std::sin(patch.angle), 0, std::cos(patch.angle)});
    mesh.tangents.clear();
    scene.meshes.push_back(mesh);
    scene.instances.push_back({static_cast<std::uint32_t>(i), glm::mat4(1.f), "quad"});
    scenes::Material material;
    material.name = std::to_string(i);
    material.doubleSided = true;
    material.baseColor = glm::vec4(patch.baseColor, 1);
    material.metallic = patch.metallic;
    material.roughness = patch.roughness;
    material.specular = patch.specular;
    material.ior = patch.ior;
    scene.materials.push_back(material);
  }
  return scene;
}

class HighendEnergyTest : public tests::DeviceTest {
protected:
  static constexpr int kSide = 24;

  // The colour of each patch.
  std::vector<glm::vec3> shade(const std::vector<Patch>& patches, const Inputs& inputs, const Options& options) const {
    const scenes::Scene scene = makeField(patches, kSide);
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kSide, kSide);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, kSide}, glm::vec2(0.5f));
    const gpu::Surface& surface = layers.front();
    EXPECT_EQ(surface.size(), patches.size());
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, options);
    const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
    std::vector<glm::vec3> colors(patches.size(), glm::vec3(-1));
    for (std::size_t i = 0; i < surface.size(); ++i) colors[surface.pixels[i]] = glm::vec3(shaded.color[i]);
    return colors;
  }

  // Every roughness of a sixteenth, seen at 0 to 88 degrees.
  static std::vector<Patch> sweep(float metallic, const glm::vec3& baseColor, float ior = 1.5f) {
    std::vector<Patch> patches;
    for (int r = 0; r <= 16; ++r)
      for (int a = 0; a <= 22; ++a)
        patches.push_back(
            {glm::radians(4.f * static_cast<float>(a)), static_cast<float>(r) / 16, metallic, baseColor, 1, ior});
    return patches;
  }
};

TEST_F(HighendEnergyTest, FurnaceStaysWithinAPercentOfOneAndNothingGainsLight) {
  const gpu::EnvironmentMaps white = tests::makeConstantEnvironment(device(), 1);
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
    const base::Image lut = makeEnvBrdfLut(term);
    const Inputs inputs{.environment = &white, .lut = &lut};
    for (const Compensation compensation :
         {Compensation::turquin, Compensation::fdezAguera, Compensation::kullaConty}) {
      const Options options{.model = {.geometryTerm = term}, .compensation = compensation};
      for (const float metallic : {0.f, 1.f}) {
        const std::vector<Patch> patches = sweep(metallic, glm::vec3(1));
        const std::vector<glm::vec3> colors = shade(patches, inputs, options);
        for (std::size_t i = 0; i < patches.size(); ++i)
          ASSERT_NEAR(colors[i].x, 1, 0.01) << "roughness " << patches[i].roughness << ", angle " << patches[i].angle
                                            << ", metallic " << metallic << ", model " << int(compensation);
      }
      for (const Patch& kind :
           {Patch{0, 0, 0, {0.5f, 0.2f, 0.9f}}, Patch{0, 0, 0.5f, {1, 1, 1}}, Patch{0, 0, 1, {0.9f, 0.6f, 0.3f}}})
        for (const glm::vec3& color : shade(sweep(kind.metallic, kind.baseColor, 2.2f), inputs, options))
          for (int c = 0; c < 3; ++c) ASSERT_TRUE(color[c] > 0 && color[c] <= 1.01f) << color[c];
    }
    // What balancing and compensating are for.
    const Options lambert{.model = {.geometryTerm = term, .diffuse = DiffuseLobe::lambert}};
    const std::vector<glm::vec3> unbalanced = shade(sweep(0, glm::vec3(1)), inputs, lambert);
    EXPECT_GT(std::max_element(unbalanced.begin(), unbalanced.end(), [](auto& a, auto& b) { return a.x < b.x; })->x,
              1.2f);
  }
}

TEST_F(HighendEnergyTest, IsFiniteAndNotNegativeForAnyMaterialUnderAnyLight) {
  const gpu::EnvironmentMaps bright = tests::makeConstantEnvironment(device(), 65504);
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  scenes::Light lamp; // on the surface, at its middle
  lamp.color = glm::vec3(1e6f);
  std::vector<Patch> patches;
  for (const float roughness : {0.f, 1e-6f, 0.015625f, 0.5f, 1.f})
    for (const float metallic : {0.f, 1.f})
      for (const float base : {0.f, 1.f})
        for (const float specular : {0.f, 1.f})
          for (const float ior : {1.f, 2.5f})
            for (const float angle : {0.f, 0.8f, 1.5707f, 1.5708f, 2.f}) // at and beyond grazing
              patches.push_back({angle, roughness, metallic, glm::vec3(base), specular, ior});
  const Inputs inputs{.environment = &bright,
                      .lut = &lut,
                      .lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(1e6f)),
                                 tests::makeDirectional({0, 0, -1}, glm::vec3(1e6f)),
                                 tests::makeDirectional({1, 0, 0.001f}, glm::vec3(1e-39f)), lamp}};
  const auto expectSane = [&](const Options& options) {
    const std::vector<glm::vec3> colors = shade(patches, inputs, options);
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_TRUE(std::isfinite(colors[i][c]) && colors[i][c] >= 0)
            << colors[i][c] << ": angle " << patches[i].angle << ", roughness " << patches[i].roughness << ", metallic "
            << patches[i].metallic << ", base " << patches[i].baseColor.x << ", ior " << patches[i].ior;
  };
  for (int i = 0; i < 4; ++i) expectSane({.compensation = static_cast<Compensation>(i)});
  for (int i = 0; i < 5; ++i) expectSane({.offSpecular = static_cast<OffSpecular>(i)});
  for (int i = 1; i < 3; ++i) expectSane({.model = {.fresnel = static_cast<FresnelCurve>(i)}});
  expectSane({.model = {.geometryTerm = GeometryTerm::schlickSmith, .diffuse = DiffuseLobe::lambert}});
}

} // namespace
} // namespace parity::highend
