// Scenes by chance, from a generator whose numbers are the same everywhere.
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/gltf/mesh_repair.h"
#include "scenes/gltf/tangents.h"
#include "scenes/texture_slots.h"
#include "study/stress/scene_parts.h"

namespace parity::stress {

using namespace parts;

namespace {

// SplitMix64 (Steele, Lea and Flood 2014): std's distributions differ between libraries.
class Dice {
public:
  explicit Dice(std::uint64_t seed) : m_state(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (m_state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  bool chance(int oneIn) { return below(oneIn) == 0; }
  float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  float power(float exponentLow, float exponentHigh) { return std::exp2(between(exponentLow, exponentHigh)); }
  // [0, 1], often an end or close to it.
  float factor() {
    switch (below(8)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return power(-24, 0);
    default:
      return unit();
    }
  }
  glm::vec3 color() {
    const float r = factor(), g = factor();
    return {r, g, factor()};
  }
  glm::vec3 direction() {
    const float z = between(-1, 1), phi = between(0, 6.2831853f), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

private:
  std::uint64_t m_state;
};

// A texture of 4x4 random texels; half of them are 0 or 255.
scenes::TextureSlot randomTexture(Dice& dice, scenes::Scene& scene) {
  scenes::TextureImage image;
  image.name = fmt::format("texture {}", scene.images.size());
  image.pixels = base::Image8(4, 4, 4);
  for (auto& value : image.pixels.pixels)
    value = static_cast<std::uint8_t>(dice.chance(2) ? (dice.chance(2) ? 255 : 0) : dice.below(256));
  scenes::TextureSlot slot;
  slot.image = static_cast<int>(scene.images.size());
  slot.sampler.minFilter = slot.sampler.magFilter = dice.chance(2) ? scenes::Filter::nearest : scenes::Filter::linear;
  const float repeats = dice.power(-2, 4);
  slot.uvTransform = {repeats, 0, dice.unit(), 0, dice.chance(8) ? 0 : repeats, dice.unit()};
  scene.images.push_back(std::move(image));
  return slot;
}

float leastGreen(const scenes::TextureImage& image) {
  std::uint8_t least = 255;
  for (std::size_t i = 1; i < image.pixels.pixels.size(); i += 4) least = std::min(least, image.pixels.pixels[i]);
  return static_cast<float>(least) / 255;
}

scenes::Material randomMaterial(Dice& dice, StressScene& s) {
  scenes::Material m;
  m.name = fmt::format("material {}", s.scene.materials.size());
  m.baseColor = glm::vec4(dice.color(), dice.factor());
  m.metallic = dice.factor();
  m.roughness = dice.factor();
  m.normalScale = dice.between(0, 3);
  m.occlusionStrength = dice.factor();
  if (dice.chance(4)) m.emissive = dice.color() * dice.power(-20, 20);
  if (dice.chance(4)) m.alphaMode = dice.chance(2) ? scenes::AlphaMode::mask : scenes::AlphaMode::blend;
  m.alphaCutoff = dice.factor();
  m.doubleSided = dice.chance(2);
  m.unlit = dice.chance(12);
  m.fullyRough = dice.chance(8);
  if (dice.chance(3)) m.ior = dice.chance(4) ? 0 : dice.between(1, 4);
  if (dice.chance(3)) m.specular = dice.factor();
  if (dice.chance(3)) m.specularColor = dice.color() * 4.f;
  float least = m.roughness;
  if (dice.chance(3)) {
    m.coat = dice.factor();
    m.coatRoughness = dice.factor();
    m.coatNormalScale = dice.between(0, 3);
  }
  if (dice.chance(3)) {
    m.sheenColor = dice.color();
    m.sheenRoughness = dice.factor();
  }
  if (dice.chance(3)) {
    m.anisotropy = dice.factor();
    m.anisotropyRotation = dice.between(-6.2831853f, 6.2831853f);
  }
  if (dice.chance(3)) {
    m.iridescence = dice.factor();
    m.iridescenceIor = dice.chance(6) ? 1 : dice.between(1, 3);
    m.iridescenceThicknessMin = dice.chance(4) ? 0 : dice.power(-4, 12);
    m.iridescenceThicknessMax = dice.chance(8) ? 0 : dice.power(-4, 12);
  }
  if (dice.chance(4)) {
    m.transmission = dice.factor();
    m.thickness = dice.chance(2) ? 0 : dice.power(-12, 12);
    m.attenuationColor = dice.color();
    m.attenuationDistance = dice.chance(3) ? 0 : dice.power(-12, 12);
    m.dispersion = dice.chance(2) ? 0 : dice.between(0, 20);
  }
  if (dice.chance(6)) {
    m.diffuseTransmission = dice.factor();
    m.diffuseTransmissionColor = dice.color();
  }
  const auto isRead = [&](const scenes::NamedSlot& each) { // as the loader leaves them
    const std::string_view key = each.key;
    if (key.starts_with("clearcoat")) return m.hasCoat();
    if (key.starts_with("sheen")) return m.hasSheen();
    if (key.starts_with("anisotropy")) return m.hasAnisotropy();
    if (key.starts_with("transmission")) return m.hasTransmission();
    if (key.starts_with("diffuseTransmission")) return m.hasDiffuseTransmission();
    if (key.starts_with("thickness")) return m.hasVolume();
    return !key.starts_with("iridescence") || m.hasIridescence();
  };
  for (const scenes::NamedSlot& each : scenes::kTextureSlots)
    if (isRead(each) && dice.chance(8)) { // few: a driver takes long over shaders that read many
      m.*each.slot = randomTexture(dice, s.scene);
      if (each.slot == &scenes::Material::metallicRoughnessTexture) least *= leastGreen(s.scene.images.back());
    }
  s.leastRoughness.push_back(least);
  return m;
}

// Triangles anywhere, some without area, some twice; normals at random, zero or NaN ones mended as the loader does.
scenes::Mesh triangleSoup(Dice& dice) {
  scenes::Mesh mesh;
  mesh.name = "soup";
  for (int t = 0; t < 24; ++t) {
    const glm::vec3 corner(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    const bool flat = dice.chance(4);
    for (int c = 0; c < 3; ++c) {
      mesh.positions.push_back(corner + (flat ? glm::vec3(0) : dice.direction() * dice.power(-12, 0)));
      mesh.normals.push_back(dice.chance(10)   ? glm::vec3(0)
                             : dice.chance(20) ? glm::vec3(std::numeric_limits<float>::quiet_NaN())
                                               : dice.direction());
      mesh.uv0.push_back({dice.unit(), flat ? 0.f : dice.unit()});
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
    }
  }
  scenes::mendNormals(mesh);
  return mesh;
}

void addObject(Dice& dice, StressScene& s) {
  scenes::Mesh mesh;
  switch (dice.below(3)) {
  case 0:
    mesh = makeBall();
    break;
  case 1:
    mesh = makeQuad(dice.chance(3) ? dice.direction() : glm::vec3(0, 0, 1));
    break;
  default:
    mesh = triangleSoup(dice);
  }
  const scenes::Material material = randomMaterial(dice, s);
  if (const std::optional<int> set = scenes::tangentSetOf(material)) scenes::makeTangents(mesh, *set);
  mesh.material = static_cast<std::uint32_t>(s.scene.materials.size());
  glm::mat4 toWorld = glm::translate(glm::mat4(1.f), dice.direction() * dice.between(0, 0.8f));
  toWorld = glm::rotate(toWorld, dice.between(0, 6.2831853f), dice.direction());
  glm::vec3 scale(dice.between(0.3f, 1));
  if (dice.chance(3)) scale = {dice.power(-8, 1), dice.power(-8, 1), dice.power(-8, 1)};
  if (dice.chance(4)) scale.x = -scale.x; // mirrored
  s.scene.instances.push_back({static_cast<std::uint32_t>(s.scene.meshes.size()), glm::scale(toWorld, scale),
                               fmt::format("object {}", s.scene.instances.size())});
  s.scene.materials.push_back(material);
  s.scene.meshes.push_back(std::move(mesh));
}

scenes::Light randomLight(Dice& dice, int index) {
  scenes::Light light;
  light.name = fmt::format("light {}", index);
  light.kind = static_cast<scenes::LightKind>(dice.below(3));
  light.color = dice.color() * (dice.chance(6) ? 1e-41f : dice.chance(6) ? 1e6f : dice.power(-6, 6));
  light.position = dice.direction() * dice.between(0, 3);
  light.direction = dice.direction();
  if (light.kind != scenes::LightKind::directional && dice.chance(2)) light.range = dice.power(-20, 6);
  light.outerConeAngle = dice.between(1e-3f, 1.5707963f);
  light.innerConeAngle = light.outerConeAngle * dice.between(0, 0.9999f);
  if (dice.chance(2)) light.falloff = scenes::Falloff::ue4;
  if (light.range > 0 && dice.chance(3)) {
    light.falloff = scenes::Falloff::exponent;
    light.falloffExponent = dice.power(-6, 9);
  }
  return light;
}

scenes::Environment randomEnvironment(Dice& dice) {
  const float radiance = dice.chance(5) ? 0 : dice.power(-10, 4);
  return makeEnvironment("random", radiance, [&](base::Image& image) {
    for (int i = 0; i < 6; ++i)
      image.pixels[static_cast<std::size_t>(dice.below(static_cast<int>(image.pixels.size())))] = dice.power(-20, 16);
  });
}

} // namespace

StressScene randomScene(std::uint64_t seed) {
  Dice dice(seed);
  StressScene s;
  s.name = fmt::format("random-{}", seed);
  s.wants = "finite, the terms sum to the colour, two renders have the same bits";
  s.scene.name = s.name;
  s.reproduce = fmt::format("--only renders --renders random-{} --seed {} --scenes 1", seed, seed);
  const int objects = 1 + dice.below(3), lights = dice.below(7);
  for (int i = 0; i < objects; ++i) addObject(dice, s);
  for (int i = 0; i < lights; ++i) s.scene.lights.push_back(randomLight(dice, i));
  if (lights == 0 || !dice.chance(3)) s.scene.environment = randomEnvironment(dice);
  if (dice.chance(5)) {
    scenes::Fog fog;
    fog.density = dice.power(-10, 4);
    fog.heightFalloff = dice.chance(2) ? 0 : dice.power(-10, 4);
    fog.height = dice.between(-2, 2);
    fog.maxOpacity = dice.factor();
    if (fog.isSeen()) s.scene.fog = fog;
  }
  s.camera = makeCamera();
  if (dice.chance(2)) {
    s.camera.orthographic = false;
    s.camera.fovYDeg = 50;
  }
  return s;
}

} // namespace parity::stress
