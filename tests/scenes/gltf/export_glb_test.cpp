// A scene that is exported and loaded again is the same scene.
#include <algorithm>
#include <array>
#include <limits>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/file.h"
#include "scenes/builtin/builtin.h"
#include "scenes/gltf/export_glb.h"
#include "scenes/gltf/file/container.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/texture.h"
#include "scenes/load.h"
#include "scenes/texture_slots.h"
#include "scenes/view.h"
#include "support/shared_assets.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Light;
using scenes::LightKind;
using scenes::Material;
using scenes::Scene;
using scenes::TextureSlot;

// Directions are made unit length when they are loaded: the last bit may change.
constexpr float kDirection = 3e-7f;

Scene reload(const Scene& scene) {
  const TempFolder folder;
  writeFile(folder / "out.glb", scenes::toGlb(scene));
  scenes::LoadOptions options;
  options.allMaterials = true;
  return scenes::loadScene((folder / "out.glb").string(), options);
}

json jsonOf(const std::vector<std::byte>& glb) { return json::parse(scenes::splitGlb(glb, "out.glb").json); }

template <typename Vec>
void expectDirections(const std::vector<Vec>& a, const std::vector<Vec>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < Vec::length(); ++c) largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
  EXPECT_LE(largest, kDirection) << what;
}

void expectSameMeshes(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    const scenes::Mesh &m = a.meshes[i], &n = b.meshes[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.material, n.material) << m.name;
    EXPECT_TRUE(m.positions == n.positions) << m.name;
    EXPECT_TRUE(m.uv0 == n.uv0) << m.name;
    EXPECT_TRUE(m.uv1 == n.uv1) << m.name;
    EXPECT_TRUE(m.colors == n.colors) << m.name;
    EXPECT_TRUE(m.indices == n.indices) << m.name;
    expectDirections(m.normals, n.normals, m.name);
    expectDirections(m.tangents, n.tangents, m.name);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].toWorld, b.instances[i].toWorld) << a.instances[i].node;
  }
}

// Images are compared by what they hold: the file has those alone that a slot reads.
void expectSameSlot(const Scene& a, const Scene& b, const TextureSlot& s, const TextureSlot& t,
                    const std::string& what) {
  ASSERT_EQ(s.present(), t.present()) << what;
  if (!s.present()) return;
  EXPECT_EQ(s.texCoord, t.texCoord) << what;
  EXPECT_EQ(s.sampler, t.sampler) << what;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(s.uvTransform[i], t.uvTransform[i], 1e-6f) << what << " " << i;
  const scenes::TextureImage &image = a.images[static_cast<std::size_t>(s.image)],
                             &again = b.images[static_cast<std::size_t>(t.image)];
  EXPECT_EQ(image.name, again.name) << what;
  EXPECT_TRUE(image.pixels == again.pixels) << what << ": " << image.name;
}

void expectSameMaterials(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const Material &m = a.materials[i], &n = b.materials[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.baseColor, n.baseColor) << m.name;
    EXPECT_EQ(m.metallic, n.metallic) << m.name;
    EXPECT_EQ(m.roughness, n.roughness) << m.name;
    EXPECT_EQ(m.emissive, n.emissive) << m.name;
    EXPECT_EQ(m.alphaMode, n.alphaMode) << m.name;
    if (m.alphaMode == scenes::AlphaMode::mask) {
      EXPECT_EQ(m.alphaCutoff, n.alphaCutoff) << m.name;
    }
    EXPECT_EQ(m.doubleSided, n.doubleSided) << m.name;
    EXPECT_EQ(m.unlit, n.unlit) << m.name;
    EXPECT_EQ(m.fullyRough, n.fullyRough) << m.name;
    EXPECT_EQ(m.ior, n.ior) << m.name;
    EXPECT_EQ(m.specular, n.specular) << m.name;
    EXPECT_EQ(m.specularColor, n.specularColor) << m.name;
    if (m.normalTexture.present()) {
      EXPECT_EQ(m.normalScale, n.normalScale) << m.name;
    }
    if (m.occlusionTexture.present()) {
      EXPECT_EQ(m.occlusionStrength, n.occlusionStrength) << m.name;
    }
    EXPECT_EQ(m.coat, n.coat) << m.name;
    EXPECT_EQ(m.coatRoughness, n.coatRoughness) << m.name;
    EXPECT_EQ(m.sheenColor, n.sheenColor) << m.name;
    EXPECT_EQ(m.sheenRoughness, n.sheenRoughness) << m.name;
    EXPECT_EQ(m.anisotropy, n.anisotropy) << m.name;
    EXPECT_EQ(m.anisotropyRotation, n.anisotropyRotation) << m.name;
    EXPECT_EQ(m.iridescence, n.iridescence) << m.name;
    EXPECT_EQ(m.iridescenceIor, n.iridescenceIor) << m.name;
    EXPECT_EQ(m.iridescenceThicknessMin, n.iridescenceThicknessMin) << m.name;
    EXPECT_EQ(m.iridescenceThicknessMax, n.iridescenceThicknessMax) << m.name;
    EXPECT_EQ(m.transmission, n.transmission) << m.name;
    EXPECT_EQ(m.thickness, n.thickness) << m.name;
    EXPECT_EQ(m.attenuationDistance, n.attenuationDistance) << m.name;
    EXPECT_EQ(m.attenuationColor, n.attenuationColor) << m.name;
    EXPECT_EQ(m.dispersion, n.dispersion) << m.name;
    EXPECT_EQ(m.diffuseTransmission, n.diffuseTransmission) << m.name;
    EXPECT_EQ(m.diffuseTransmissionColor, n.diffuseTransmissionColor) << m.name;
    if (m.coatNormalTexture.present()) {
      EXPECT_EQ(m.coatNormalScale, n.coatNormalScale) << m.name;
    }
    for (const scenes::NamedSlot& each : scenes::kTextureSlots)
      expectSameSlot(a, b, m.*each.slot, n.*each.slot, m.name + ": " + each.name);
  }
}

void expectSameLights(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const Light &l = a.lights[i], &k = b.lights[i];
    EXPECT_EQ(l.name, k.name);
    EXPECT_EQ(l.kind, k.kind) << l.name;
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(l.color[c], k.color[c]) << l.name;
    EXPECT_EQ(l.position, k.position) << l.name;
    EXPECT_EQ(l.range, k.range) << l.name;
    EXPECT_EQ(l.falloff, k.falloff) << l.name;
    EXPECT_EQ(l.falloffExponent, k.falloffExponent) << l.name;
    if (l.kind != LightKind::point) {
      EXPECT_LE(glm::length(l.direction - k.direction), kDirection) << l.name;
    }
    if (l.kind != LightKind::spot) continue;
    EXPECT_EQ(l.innerConeAngle, k.innerConeAngle) << l.name;
    EXPECT_EQ(l.outerConeAngle, k.outerConeAngle) << l.name;
  }
}

void expectSameCameras(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    const bool isDefault = static_cast<int>(i) == a.defaultCamera;
    const scenes::Camera c = isDefault ? scenes::makeCamera(a, {}, 1.f) : a.cameras[i], &d = b.cameras[i];
    EXPECT_EQ(c.name, d.name);
    EXPECT_EQ(c.orthographic, d.orthographic) << c.name;
    if (c.orthographic)
      EXPECT_EQ(c.halfHeight, d.halfHeight) << c.name;
    else
      EXPECT_FLOAT_EQ(c.fovYDeg, d.fovYDeg) << c.name;
    EXPECT_EQ(c.zNear, d.zNear) << c.name;
    EXPECT_EQ(c.zFar, d.zFar) << c.name;
    for (int n = 0; n < 3; ++n) EXPECT_LE(glm::length(c.toWorld[n] - d.toWorld[n]), 2 * kDirection) << c.name;
    EXPECT_EQ(c.toWorld[3], d.toWorld[3]) << c.name;
  }
}

void expectSame(const Scene& a, const Scene& b) {
  expectSameMeshes(a, b);
  expectSameMaterials(a, b);
  expectSameLights(a, b);
  expectSameCameras(a, b);
}

TEST(ExportGlb, EveryBuiltinSceneIsTheSameWhenItIsLoadedAgain) {
  for (const std::string& name : scenes::builtinSceneNames()) {
    SCOPED_TRACE(name);
    const Scene scene = scenes::makeBuiltinScene(name), again = reload(scene);
    expectSame(scene, again);
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
    EXPECT_TRUE(scenes::listNotInGltf(scene).empty());
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
      EXPECT_EQ(scene.instances[i].node, again.instances[i].node);
  }
}

TEST(ExportGlb, IsTheSameBytesEachTime) {
  for (const std::string name : {"materials", "lamps"})
    EXPECT_TRUE(scenes::toGlb(scenes::makeBuiltinScene(name)) == scenes::toGlb(scenes::makeBuiltinScene(name))) << name;
}

TEST(ExportGlb, RealAssetsAreTheSameWhenTheyAreLoadedAgain) {
  const std::filesystem::path folder = sharedAssets();
  if (folder.empty()) GTEST_SKIP() << "PARITY_SHARED names no folder with assets/manifest.json";
  const json manifest = json::parse(base::readText(folder / "manifest.json"));
  std::size_t tried = 0;
  for (const auto& asset : manifest["assets"]) {
    const std::filesystem::path file = folder / asset["entry"].get<std::string>();
    SCOPED_TRACE(file.string());
    scenes::LoadOptions options;
    options.allMaterials = true;
    const Scene scene = scenes::loadScene(file.string(), options);
    constexpr std::size_t kMostTexels = std::size_t{6} << 20; // the others take seconds each
    std::size_t texels = 0;
    for (const scenes::TextureImage& image : scene.images) texels += image.pixels.pixelCount();
    if (texels > kMostTexels) continue;
    expectSame(scene, reload(scene));
    ++tried;
  }
  EXPECT_GT(tried, 3u);
}

// An image whose texels all differ, also where alpha is 0.
scenes::TextureImage makeImage(const std::string& name) {
  scenes::TextureImage image{name, base::Image8(16, 8, 4)};
  for (std::size_t i = 0; i < image.pixels.pixels.size(); ++i)
    image.pixels.pixels[i] = static_cast<std::uint8_t>(i % 4 == 3 ? i / 4 * 2 : i * 37 + name.size());
  return image;
}

TextureSlot makeSlot(int image, std::array<float, 6> uvTransform = TextureSlot().uvTransform) {
  TextureSlot slot;
  slot.image = image;
  slot.uvTransform = uvTransform;
  return slot;
}

// What the built-in scenes have not: all slots with transforms, samplers of all kinds, all numbers off their defaults.
Scene makeEverything() {
  Scene scene;
  scene.name = "every\xffthing";
  for (const char* name : {"first", "second image", "third", "nobody reads it"})
    scene.images.push_back(makeImage(name));

  Material m;
  m.name = "painted \"steel\" \u00e4";
  m.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
  m.metallic = 0.7f;
  m.roughness = 0.31f;
  m.normalScale = 0.6f;
  m.occlusionStrength = 0.9f;
  m.emissive = {3.3f, 0.7f, 123.4f};
  m.alphaMode = scenes::AlphaMode::mask;
  m.alphaCutoff = 0.23f;
  m.doubleSided = true;
  m.fullyRough = true;
  m.ior = 1.33f;
  m.specular = 0.8f;
  m.specularColor = {0.9f, 1.5f, 0.2f};
  m.baseColorTexture = makeSlot(0, scenes::uvTransform({0.25, -0.5}, 0.7, {2, 3}));
  m.metallicRoughnessTexture = makeSlot(1, {2, 0, 0, 0, -1, 1}); // mirrored
  m.normalTexture = makeSlot(1);
  m.occlusionTexture = makeSlot(0, scenes::uvTransform({0, 0}, -3, {0.1, 40}));
  m.emissiveTexture = makeSlot(2, {0, 0, 0.5f, 0, 0, 0.5f}); // one texel everywhere
  m.specularTexture = makeSlot(2, scenes::uvTransform({1, 2}, glm::half_pi<double>(), {1, 1}));
  m.specularColorTexture = makeSlot(2, {0, 3, 0, 0, 0, 0}); // of one column alone
  m.normalTexture.texCoord = m.specularTexture.texCoord = 1;
  m.coat = 0.35f;
  m.coatRoughness = 0.15f;
  m.coatNormalScale = 1.7f;
  m.sheenColor = {0.6f, 0.1f, 1};
  m.sheenRoughness = 0.45f;
  m.coatTexture = makeSlot(0, scenes::uvTransform({0.1, 0.2}, 0.3, {4, 5}));
  m.coatRoughnessTexture = makeSlot(1);
  m.coatNormalTexture = makeSlot(2, scenes::uvTransform({0, 0}, 1, {1, 1}));
  m.sheenColorTexture = makeSlot(0);
  m.sheenRoughnessTexture = makeSlot(1, {3, 0, 0, 0, 3, 0});
  m.coatNormalTexture.texCoord = m.sheenRoughnessTexture.texCoord = 1;
  m.anisotropy = 0.65f;
  m.anisotropyRotation = -2.2f;
  m.iridescence = 0.85f;
  m.iridescenceIor = 1.9f;
  m.iridescenceThicknessMin = 123.4f;
  m.iridescenceThicknessMax = 567.8f;
  m.anisotropyTexture = makeSlot(2, scenes::uvTransform({0.3, 0.1}, 0, {2, 2}));
  m.iridescenceTexture = makeSlot(0, scenes::uvTransform({0, 0}, 2, {3, 1}));
  m.iridescenceThicknessTexture = makeSlot(1);
  m.anisotropyTexture.texCoord = m.iridescenceThicknessTexture.texCoord = 1;
  m.transmission = 0.55f;
  m.thickness = 0.012f;
  m.attenuationDistance = 0.3f;
  m.attenuationColor = {0.7f, 0.2f, 0.9f};
  m.dispersion = 0.31f;
  m.diffuseTransmission = 0.45f;
  m.diffuseTransmissionColor = {0.3f, 0.9f, 0.2f};
  m.transmissionTexture = makeSlot(1, scenes::uvTransform({0.5, 0.1}, 0, {2, 1}));
  m.thicknessTexture = makeSlot(2);
  m.diffuseTransmissionTexture = makeSlot(0);
  m.diffuseTransmissionColorTexture = makeSlot(0, scenes::uvTransform({0, 0}, 1, {2, 2}));
  m.thicknessTexture.texCoord = 1;
  using scenes::Filter, scenes::Wrap;
  m.baseColorTexture.sampler = {Wrap::mirroredRepeat, Wrap::clampToEdge, Filter::nearest,
                                Filter::linear,       Filter::nearest,   true};
  m.normalTexture.sampler = {Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, Filter::linear, true};
  m.occlusionTexture.sampler = {Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, Filter::nearest, false};
  m.emissiveTexture.sampler = {Wrap::repeat, Wrap::repeat, Filter::linear, Filter::linear, Filter::nearest, false};
  Material glass, sign;
  glass.name = "glass";
  glass.alphaMode = scenes::AlphaMode::blend;
  glass.ior = 0;
  glass.emissive = glm::vec3(3.3e38f, 0, 0); // a power of two above it is no float
  sign.name = "sign";
  sign.unlit = true;
  sign.emissive = glm::vec3(1, 0.5f, 0);
  scene.materials = {m, glass, sign};

  scenes::Mesh mesh;
  mesh.name = "a triangle";
  mesh.positions = {{0, 0, 0}, {1.1f, 0, 0}, {0, 1.3f, -0.7f}};
  mesh.normals = std::vector<glm::vec3>(3, glm::vec3(0, 0, 1));
  mesh.tangents = {{1, 0, 0, 1}, {0.6f, 0.8f, 0, -1}, {0, 1, 0, 1}};
  mesh.uv0 = {{0, 0}, {1, 0}, {0, 1}};
  mesh.uv1 = {{0.5f, 0}, {-1, 7}, {0, 1e-3f}};
  mesh.colors = {{1, 0, 0, 1}, {0.1f, 0.2f, 0.3f, 0.4f}, {0, 0, 0, 0}};
  mesh.indices = {2, 0, 1};
  scenes::Mesh other = mesh;
  other.name = "another";
  other.material = 1;
  other.tangents.clear();
  other.colors.clear();
  scene.meshes = {mesh, other};
  const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.f), {1, -2, 3}), 0.4f, {0.6f, 0, 0.8f});
  scene.instances = {{0, glm::scale(turned, {1, 2, -3}), "hall/left"}, {1, glm::mat4(1.f), "b"}, {0, turned, "c"}};

  Light sun{.name = "sun", .kind = LightKind::directional, .color = {7, 6, 0.1f}};
  sun.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
  Light spot{.name = "spot", .kind = LightKind::spot, .color = {900, 1000, 1100}, .position = {1, 2, 3}, .range = 12};
  spot.direction = {0, -1, 0};
  spot.innerConeAngle = 0.2f;
  spot.outerConeAngle = glm::half_pi<float>();
  Light bulb{.name = "bulb", .color = {0.2f, 0.1f, 0.3f}, .position = {-1, 0.1f, 4}, .range = 3};
  Light soft = bulb;
  soft.name = "soft";
  soft.falloff = scenes::Falloff::exponent;
  soft.falloffExponent = 2.5f;
  Light black{.name = "black", .color = glm::vec3(0)};
  scene.lights = {sun, spot, bulb, soft, black};

  const glm::mat4 eye = glm::rotate(glm::translate(glm::mat4(1.f), {0.3f, 1, 9}), 0.1f, {0, 1, 0});
  scene.cameras = {{.name = "infinite", .toWorld = eye, .fovYDeg = 33, .zNear = 0.2f, .zFar = 0},
                   {.name = "flat", .toWorld = eye, .orthographic = true, .halfHeight = 2.2f, .zNear = 0, .zFar = 40},
                   {.name = "plain", .toWorld = glm::mat4(1.f), .fovYDeg = 60, .zNear = 0.1f, .zFar = 50}};
  return scene;
}

TEST(ExportGlb, KeepsTransformsSamplersSpotsAndOrthographicCameras) {
  const Scene scene = makeEverything(), again = reload(scene);
  expectSame(scene, again);
  EXPECT_EQ(again.images.size(), 3u) << "without the one that no slot reads";
  EXPECT_EQ(again.facts.scenes, std::vector<std::string>{"every\uFFFDthing"});
  EXPECT_EQ(again.warnings.size(), 1u) << "of the light that is black";
  EXPECT_EQ(again.facts.generator, "parity");
}

TEST(ExportGlb, WritesWhatTheSpecificationAsksFor) {
  const std::vector<std::byte> glb = scenes::toGlb(makeEverything());
  EXPECT_EQ(glb.size() % 4, 0u);
  const json file = jsonOf(glb);
  EXPECT_EQ(file["buffers"][0]["byteLength"], file["bufferViews"].back()["byteOffset"].get<std::size_t>() +
                                                  file["bufferViews"].back()["byteLength"].get<std::size_t>());
  const json& position = file["accessors"][file["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
  EXPECT_EQ(position["max"], json({1.1f, 1.3f, 0.f}));
  EXPECT_EQ(position["min"], json({0.f, 0.f, -0.7f}));
  for (const json& view : file["bufferViews"]) EXPECT_EQ(view.value("byteOffset", 0) % 4, 0);
  const json used = {"KHR_lights_punctual",        "KHR_materials_anisotropy",
                     "KHR_materials_clearcoat",    "KHR_materials_diffuse_transmission",
                     "KHR_materials_dispersion",   "KHR_materials_emissive_strength",
                     "KHR_materials_ior",          "KHR_materials_iridescence",
                     "KHR_materials_sheen",        "KHR_materials_specular",
                     "KHR_materials_transmission", "KHR_materials_unlit",
                     "KHR_materials_volume",       "KHR_texture_transform"};
  EXPECT_EQ(file["extensionsUsed"], used);
  for (const json& light : file["extensions"]["KHR_lights_punctual"]["lights"])
    for (const json& channel : light["color"]) EXPECT_LE(channel, 1.0);
  EXPECT_FALSE(file["cameras"][0]["perspective"].contains("zfar")) << "an infinite one has none";
  for (const json& material : file["materials"])
    for (const json& channel : material.value("emissiveFactor", json::array())) EXPECT_LE(channel, 1.0);
  for (const char* lobe : {"clearcoat", "sheen", "anisotropy", "iridescence", "transmission", "volume", "dispersion",
                           "diffuse_transmission"})
    EXPECT_FALSE(file["materials"][1]["extensions"].contains(std::string("KHR_materials_") + lobe)) << "it has none";
  EXPECT_EQ(file["images"].size(), 3u);
  EXPECT_EQ(file["images"][0]["mimeType"], "image/png");
  EXPECT_FALSE(file["nodes"][1].contains("matrix")) << "the identity is the default";
  EXPECT_FALSE(file.contains("animations"));
}

TEST(ExportGlb, NumbersUvSetsWithoutGaps) {
  Scene scene = makeEverything();
  for (scenes::Mesh& mesh : scene.meshes) mesh.uv0.clear();
  const Scene again = reload(scene);
  EXPECT_EQ(again.meshes[0].uv1, scene.meshes[0].uv1);
  EXPECT_EQ(again.meshes[0].uv0, std::vector<glm::vec2>(3)) << "as it is read where it is absent";
}

TEST(ExportGlb, LeavesOutAMeshWithoutTriangles) {
  Scene scene = makeEverything();
  scene.meshes[0].indices.clear();
  const Scene again = reload(scene);
  ASSERT_EQ(again.meshes.size(), 1u);
  EXPECT_EQ(again.meshes[0].name, "another");
  EXPECT_EQ(again.instances.size(), 1u);
}

TEST(ExportGlb, SaysWhatGltfCannot) {
  Scene scene = makeEverything();
  scene.lights[0].specularScale = 0.5f;
  scene.lights[1].falloff = scenes::Falloff::ue4;
  scene.instances[1].toWorld[1].x = 0.3f; // y leans
  scene.fog = scenes::Fog{.density = 0.1f};
  scene.lightScales.sunSpecularScale = 2;
  const std::vector<std::string> lines = scenes::listNotInGltf(scene);
  for (const char* part : {"light 'sun': glTF has no scale of specular light (0.5)",
                           "light 'spot': glTF does not know the falloff of Unreal Engine 4",
                           "light 'soft': glTF has no falloff exponent (2.5)", "node 'b': its matrix is sheared", "fog",
                           "scales of light"})
    EXPECT_TRUE(hasWarning(lines, part)) << part;
  EXPECT_EQ(lines.size(), 6u);
}

TEST(ExportGlb, RefusesATransformThatTheExtensionCannotSay) {
  Scene scene = makeEverything();
  scene.materials[0].normalTexture.uvTransform = {1, 0.5f, 0, 0, 1, 0};
  expectError([&] { scenes::toGlb(scene); }, {"material 'painted", "normalTexture", "sheared"});
}

TEST(ExportGlb, RefusesAnImageThatWasNotRead) {
  Scene scene = makeEverything();
  scene.images[1].pixels = {};
  expectError([&] { scenes::toGlb(scene); }, {"image 'second image'", "was not read"});
}

TEST(ExportGlb, SplitsEveryTransformOfTheExtension) {
  for (const double rotation : {0.0, 0.3, -1.5, 3.0, glm::pi<double>(), -glm::half_pi<double>()})
    for (const glm::dvec2 scale : {glm::dvec2(1, 1), {3, 0.2}, {-2, 1}, {1, -4}, {-1, -1}, {0, 2}, {5, 0}, {0, 0}}) {
      const auto matrix = scenes::uvTransform({0.5, -7}, rotation, scale);
      const auto parts = scenes::splitUvTransform(matrix);
      ASSERT_TRUE(parts) << rotation << " " << scale.x << " " << scale.y;
      const auto again = scenes::uvTransform(parts->offset, parts->rotation, parts->scale);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(matrix[i], again[i], 1e-6f) << rotation << " " << i;
    }
  EXPECT_FALSE(scenes::splitUvTransform({1, 1, 0, 0, 1, 0}));
  EXPECT_FALSE(scenes::splitUvTransform({1, 0, 0, std::numeric_limits<float>::quiet_NaN(), 1, 0}));
}

} // namespace
} // namespace parity::tests
