// Preset folders of the high-end path: every function that a folder defines is the one that is called.
#include "highend_quad.h"

#include <filesystem>

#include "highend/programs.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::highend {
namespace {

using shading::Term;

TEST_F(HighendTest, AFolderDefinesLobesAttenuationAndEnvironmentBrdf) {
  const tests::TempFolder folder;
  tests::writeFile(folder / "preset.toml",
                   "path = \"highend\"\n[knobs]\ncompensation = \"none\"\ndiffuse = \"lambert\"\n"
                   "off_specular = \"none\"\n");
  tests::writeFile(folder / "preset.glsl", R"(
vec3 presetEnvironmentBrdf(float NoV, float roughness) { return vec3(0.0, 0.25 * NoV + 0.5 * roughness, 1.0); }
vec3 presetDirectLobe(Shader s, vec3 L, float NoL, float NoH, float VoH) { return vec3(NoL, s.F0.x, s.roughness); }
vec3 presetDiffuseLobe(Shader s, float NoL, float VoH) { return vec3(3.14159265358979 * NoL); }
float presetDistanceFalloff(int falloff, float d2, float range, float exponent) { return 0.5; }
float presetSpotCone(float cosAngle, float cosInner, float cosOuter) { return 0.25; }
)");
  const Options options = optionsOfFolder(folder.path().string());
  EXPECT_EQ(options.compensation, Compensation::none);
  EXPECT_EQ(options.offSpecular, OffSpecular::none);
  scenes::Scene scene = tests::makeLeaningQuad(0);
  scene.materials[0].baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1);
  scene.materials[0].metallic = 0;
  scene.materials[0].roughness = 0.5f;
  // Light from the front, N.L = 1: E of it is the illuminance.
  const tests::ShadedPoint sun = shade(scene, {.lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(2))}}, options);
  EXPECT_NEAR(sun[Term::sunSpecular].x, 2, 1e-5);
  EXPECT_NEAR(sun[Term::sunSpecular].y, 2 * 0.04, 1e-5);
  EXPECT_NEAR(sun[Term::sunSpecular].z, 2 * 0.5, 1e-5);
  EXPECT_NEAR(sun[Term::sunDiffuse].x, 2, 1e-5);

  scenes::Light spot;
  spot.kind = scenes::LightKind::spot;
  spot.position = {0, 0, 3};
  spot.direction = {0, 0, -1};
  spot.color = glm::vec3(8);
  spot.innerConeAngle = 0.2f, spot.outerConeAngle = 0.5f;
  const tests::ShadedPoint lamp = shade(scene, {.lights = {spot}}, options);
  EXPECT_NEAR(lamp[Term::localSpecular].z, 8 * 0.5 * 0.25 * 0.5, 1e-5);

  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const base::Image lut = constantLut(0.9f, 0.1f); // which is not read
  const tests::ShadedPoint lit = shade(scene, {.environment = &sky, .lut = &lut}, options);
  EXPECT_NEAR(lit[Term::skySpecular].x, 0.25 + 0.5 * 0.5, 1e-4); // A is 0, F90 is 1
  paths::forgetPresetFolders();
}

} // namespace
} // namespace parity::highend
