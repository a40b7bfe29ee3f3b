// parity info: what is in a scene's file.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include <nlohmann/json.hpp>

#include "base/log.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "scenes/light_names.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"

namespace parity::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kAlphaModes[] = {"opaque", "mask", "blend"};

Json toJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json materialsJson(const scenes::Scene& scene, const scenes::SceneInfo& info) {
  Json list = Json::array();
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const scenes::Material& material = scene.materials[m];
    const glm::vec4& c = material.baseColor;
    list.push_back({{"name", material.name},
                    {"triangles", info.materials[m].triangles},
                    {"flags", info.materials[m].flags},
                    {"baseColor", {c.x, c.y, c.z, c.w}},
                    {"metallic", material.metallic},
                    {"roughness", material.roughness},
                    {"f0", toJson(info.materials[m].f0)},
                    {"emissive", toJson(material.emissive)},
                    {"coat", material.coat},
                    {"coatRoughness", material.coatRoughness},
                    {"sheenColor", toJson(material.sheenColor)},
                    {"sheenRoughness", material.sheenRoughness},
                    {"anisotropy", material.anisotropy},
                    {"anisotropyRotation", material.anisotropyRotation},
                    {"iridescence", material.iridescence},
                    {"iridescenceIor", material.iridescenceIor},
                    {"iridescenceThickness", {material.iridescenceThicknessMin, material.iridescenceThicknessMax}},
                    {"transmission", material.transmission},
                    {"diffuseTransmission", material.diffuseTransmission},
                    {"diffuseTransmissionColor", toJson(material.diffuseTransmissionColor)},
                    {"ior", material.ior},
                    {"thickness", material.thickness},
                    {"attenuationDistance", material.attenuationDistance},
                    {"attenuationColor", toJson(material.attenuationColor)},
                    {"dispersion", material.dispersion},
                    {"alphaMode", kAlphaModes[static_cast<int>(material.alphaMode)]},
                    {"alphaCutoff", material.alphaCutoff},
                    {"textures", info.materials[m].textures},
                    {"notModelled", material.notModelled}});
  }
  return list;
}

Json infoJson(const std::string& file, const scenes::Scene& scene, const scenes::SceneInfo& info) {
  const scenes::SourceFacts& facts = scene.facts;
  Json counts = Json::object();
  for (const auto& [name, count] : facts.counts) counts[name] = count;
  Json lights = Json::array(), cameras = Json::array(), animations = Json::array();
  for (std::size_t a = 0; a < facts.animations.size(); ++a)
    animations.push_back({{"name", facts.animations[a]}, {"seconds", facts.animationSeconds[a]}});
  for (const scenes::Light& light : scene.lights) {
    lights.push_back({{"name", light.name},
                      {"kind", scenes::nameOf(light.kind)},
                      {"color", toJson(light.color)},
                      {"range", light.range}});
    if (light.falloff == scenes::Falloff::exponent) lights.back()["falloffExponent"] = light.falloffExponent;
  }
  for (const scenes::Camera& camera : scene.cameras)
    cameras.push_back({{"name", camera.name}, {"kind", camera.orthographic ? "orthographic" : "perspective"}});
  return {{"file", file},
          {"gltf", facts.version},
          {"generator", facts.generator},
          {"copyright", facts.copyright},
          {"extensionsUsed", facts.extensionsUsed},
          {"extensionsRequired", facts.extensionsRequired},
          {"scenes", facts.scenes},
          {"animations", animations},
          {"variants", facts.variants},
          {"arrays", counts},
          {"triangles", info.triangles},
          {"vertices", info.vertices},
          {"instances", info.instances},
          {"bounds", {{"lower", toJson(info.bounds.lower)}, {"upper", toJson(info.bounds.upper)}}},
          {"images", info.images},
          {"texels", info.texels},
          {"memory", {{"meshes", info.meshBytes}, {"images", info.imageBytes}}},
          {"materials", materialsJson(scene, info)},
          {"lights", lights},
          {"cameras", cameras},
          {"warnings", scene.warnings}};
}

double toMib(std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

void printNames(const char* what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < names.size(); ++i) shown.push_back(names[i].empty() ? fmt::format("({})", i) : names[i]);
  cli::print("{:<11} {}\n", what, fmt::join(shown, ", "));
}

std::string withValues(const std::string& flag, const scenes::Material& m) {
  if (flag == "alpha mask") return fmt::format("alpha mask below {:.3g}", m.alphaCutoff);
  if (flag == "coat") return fmt::format("coat {:.3g} of roughness {:.3g}", m.coat, m.coatRoughness);
  if (flag == "sheen")
    return fmt::format("sheen ({:.3g}, {:.3g}, {:.3g}) of roughness {:.3g}", m.sheenColor.x, m.sheenColor.y,
                       m.sheenColor.z, m.sheenRoughness);
  if (flag == "anisotropy")
    return fmt::format("anisotropy {:.3g} turned by {:.3g} degrees", m.anisotropy, glm::degrees(m.anisotropyRotation));
  if (flag == "iridescence") {
    const std::string from =
        m.iridescenceThicknessTexture.present() ? fmt::format("{:.4g} to ", m.iridescenceThicknessMin) : "";
    return fmt::format("iridescence {:.3g} of index {:.3g} and {}{:.4g} nm", m.iridescence, m.iridescenceIor, from,
                       m.iridescenceThicknessMax);
  }
  if (flag == "transmission") return fmt::format("transmission {:.3g}", m.transmission);
  if (flag == "volume")
    return fmt::format("volume of thickness {:.3g} and index {:.3g}{}{}", m.thickness, m.ior,
                       m.attenuationDistance > 0
                           ? fmt::format(", ({:.3g}, {:.3g}, {:.3g}) over {:.3g} m", m.attenuationColor.x,
                                         m.attenuationColor.y, m.attenuationColor.z, m.attenuationDistance)
                           : "",
                       m.dispersion > 0 ? fmt::format(", dispersion {:.3g}", m.dispersion) : "");
  if (flag == "diffuse transmission")
    return fmt::format("diffuse transmission {:.3g} of ({:.3g}, {:.3g}, {:.3g})", m.diffuseTransmission,
                       m.diffuseTransmissionColor.x, m.diffuseTransmissionColor.y, m.diffuseTransmissionColor.z);
  return flag;
}

// The flags, those with the numbers that belong to them.
std::vector<std::string> flagsWithValues(const scenes::Material& material, const scenes::MaterialInfo& info) {
  std::vector<std::string> flags;
  for (const std::string& flag : info.flags) flags.push_back(withValues(flag, material));
  if (!material.notModelled.empty())
    flags.push_back(fmt::format("not modelled: {}", fmt::join(material.notModelled, ", ")));
  return flags;
}

void printInfo(const std::string& file, const scenes::Scene& scene, const scenes::SceneInfo& info) {
  const scenes::SourceFacts& facts = scene.facts;
  cli::print("{}\n", file);
  if (!facts.version.empty())
    cli::print("{:<11} {}{}{}\n", "glTF", facts.version, facts.generator.empty() ? "" : ", ", facts.generator);
  if (!facts.copyright.empty()) cli::print("{:<11} {}\n", "copyright", facts.copyright);
  std::vector<std::string> counts;
  for (const auto& [name, count] : facts.counts) counts.push_back(fmt::format("{} {}", count, name));
  if (!counts.empty()) cli::print("{:<11} {}\n", "file", fmt::join(counts, ", "));
  cli::print("{:<11} {} triangles, {} vertices, {} instances\n", "shown", info.triangles, info.vertices,
             info.instances);
  const glm::vec3 size = info.bounds.upper - info.bounds.lower;
  cli::print("{:<11} {:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g})\n", "bounds", size.x, size.y, size.z,
             info.bounds.lower.x, info.bounds.lower.y, info.bounds.lower.z);
  cli::print("{:<11} {:.1f} MiB of meshes, {:.1f} MiB of {} images ({:.2f} megapixels)\n", "memory",
             toMib(info.meshBytes), toMib(info.imageBytes), info.images, static_cast<double>(info.texels) / 1e6);
  printNames("extensions", facts.extensionsUsed);
  printNames("scenes", facts.scenes);
  std::vector<std::string> animations;
  for (std::size_t a = 0; a < facts.animations.size(); ++a)
    animations.push_back(fmt::format("{} (0 to {:.4g} s)",
                                     facts.animations[a].empty() ? fmt::format("({})", a) : facts.animations[a],
                                     facts.animationSeconds[a]));
  printNames("animations", animations);
  printNames("variants", facts.variants);
  for (const scenes::Camera& camera : scene.cameras)
    cli::print("{:<11} {}, {}\n", "camera", camera.name, camera.orthographic ? "orthographic" : "perspective");
  for (const scenes::Light& light : scene.lights) {
    const bool hasExponent = light.falloff == scenes::Falloff::exponent;
    cli::print("{:<11} {}, {}, ({:.4g}, {:.4g}, {:.4g}) {}{}{}\n", "light", light.name, scenes::nameOf(light.kind),
               light.color.x, light.color.y, light.color.z,
               light.kind == scenes::LightKind::directional || hasExponent ? "lx" : "cd",
               light.range > 0 ? fmt::format(", range {:.4g} m", light.range) : "",
               hasExponent ? fmt::format(", falloff exponent {:.4g}", light.falloffExponent) : "");
  }

  std::size_t width = 8;
  for (const scenes::MaterialInfo& material : info.materials)
    width = std::max(width, std::min<std::size_t>(material.name.size(), 40));
  cli::print("\n{:<{}} {:>10} {:>8} {:>9}  {}\n", "material", width, "triangles", "metallic", "roughness", "flags");
  for (std::size_t m = 0; m < info.materials.size(); ++m) {
    const scenes::MaterialInfo& material = info.materials[m];
    cli::print("{:<{}} {:>10} {:>8.3g} {:>9.3g}  {}\n", material.name, width, material.triangles,
               scene.materials[m].metallic, scene.materials[m].roughness,
               fmt::join(flagsWithValues(scene.materials[m], material), ", "));
    for (const std::string& texture : material.textures) cli::print("{:<{}}   {}\n", "", width, texture);
  }
}

} // namespace

int runInfoCommand(const InfoCommand& command) {
  const scenes::Scene scene = scenes::loadScene(command.scene, command.common.settings.scene.load);
  const scenes::SceneInfo info = scenes::describeScene(scene);
  if (!command.common.json.empty()) writeJson(command.common.json, dumpJson(infoJson(command.scene, scene, info)));
  if (command.common.json == "-") return 0;
  printInfo(command.scene, scene, info);
  if (!scene.warnings.empty()) cli::print("\n");
  for (const std::string& warning : scene.warnings) cli::print("warning: {}\n", warning);
  return 0;
}

} // namespace parity::cli
