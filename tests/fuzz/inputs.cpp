// Bytes through the loaders, as the fuzz targets and the test of their corpus do it.
#include "fuzz/inputs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/image/image_io.h"
#include "scenes/builtin/material_balls.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"
#include "scenes/texture_slots.h"

namespace parity::tests {
namespace {

namespace fs = std::filesystem;

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string findMeshFault(const scenes::Scene& scene, const scenes::Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (mesh.indices.empty() || mesh.indices.size() % 3) return "a number of indices that is no multiple of 3";
  if (std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t i) { return i >= count; }))
    return "an index beyond the vertices";
  if (mesh.material >= scene.materials.size()) return "a material that is not there";
  if (mesh.normals.size() != count) return "not as many normals as vertices";
  for (const std::size_t size : {mesh.tangents.size(), mesh.uv0.size(), mesh.uv1.size(), mesh.colors.size()})
    if (size != 0 && size != count) return "an attribute of another size";
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), isFinite)) return "a position that is not finite";
  if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), isFinite)) return "a normal that is not finite";
  return {};
}

// Reports hold JSON, which takes UTF-8 alone.
bool isUtf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

// What no later step may meet in a scene that was loaded.
std::string findFault(const scenes::Scene& scene) {
  for (const scenes::Mesh& mesh : scene.meshes)
    if (const std::string fault = findMeshFault(scene, mesh); !fault.empty()) return fault;
  for (const scenes::Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) return "an instance of no mesh";
    for (int c = 0; c < 4; ++c)
      if (!isFinite(instance.toWorld[c])) return "an instance whose place is not finite";
  }
  for (const scenes::Material& material : scene.materials)
    for (const scenes::NamedSlot& each : scenes::kTextureSlots)
      if ((material.*each.slot).image >= static_cast<int>(scene.images.size())) return "a texture of no image";
  for (const scenes::Material& material : scene.materials) {
    const glm::vec3 sheen = material.sheenColor, through = material.diffuseTransmissionColor,
                    kept = material.attenuationColor;
    for (const float factor : {material.coat, material.coatRoughness, material.sheenRoughness, sheen.x, sheen.y,
                               sheen.z, material.anisotropy, material.iridescence, material.transmission,
                               material.diffuseTransmission, through.x, through.y, through.z, kept.x, kept.y, kept.z})
      if (!(factor >= 0 && factor <= 1)) return "a factor of a lobe out of range";
    if (!(std::abs(material.anisotropyRotation) <= 6.2831855f)) return "a rotation of many turns";
    if (!(material.iridescenceIor >= 1)) return "a film whose index is below 1";
    for (const float thickness : {material.iridescenceThicknessMin, material.iridescenceThicknessMax})
      if (!(thickness >= 0 && std::isfinite(thickness))) return "a film of no real thickness";
    if (!(material.thickness >= 0 && std::isfinite(material.thickness))) return "a body of no real thickness";
    if (!(material.attenuationDistance >= 0)) return "an attenuation over less than nothing";
    if (!isFinite(material.absorption())) return "an absorption that is not finite";
    if (!(material.dispersion >= 0 && material.dispersion <= 20)) return "a dispersion out of range";
  }
  for (const scenes::Material& material : scene.materials)
    if (!isUtf8(material.name)) return "a name that is not UTF-8";
  for (const std::string& warning : scene.warnings)
    if (!isUtf8(warning)) return "a warning that is not UTF-8";
  for (const scenes::Light& light : scene.lights)
    if (!isFinite(light.color) || !isFinite(light.position) || !isFinite(light.direction))
      return "a light that is not finite";
  return {};
}

// A refusal is told in words that begin with the file.
InputResult refusedBy(const base::Error& error, const std::string& file) {
  InputResult result{.isRefused = true, .reason = error.what()};
  if (error.code() != base::ExitCode::failed) result.fault = "refused with another exit code: " + result.reason;
  if (!result.reason.starts_with(file) || result.reason.size() < file.size() + 4)
    result.fault = "refused without file and reason: " + result.reason;
  if (!isUtf8(result.reason)) result.fault = "refused in words that are not UTF-8";
  return result;
}

} // namespace

InputFolder::InputFolder() {
  const fs::path memory = "/dev/shm";
  std::error_code failed;
  const fs::path parent = fs::is_directory(memory, failed) ? memory : fs::temp_directory_path();
  std::string name = (parent / "parity-fuzz-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
  m_path = name;
}

InputFolder::~InputFolder() {
  std::error_code ignored; // a destructor cannot report it
  fs::remove_all(m_path, ignored);
}

std::string InputFolder::write(const std::string& name, std::span<const std::byte> bytes) const {
  const std::string file = (m_path / name).string();
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file);
  return file;
}

InputResult loadGltfBytes(const InputFolder& folder, std::span<const std::byte> bytes) {
  const std::string file = folder.write("input.gltf", bytes); // a .glb is told by its first bytes
  scenes::LoadOptions options;
  options.timeSeconds = 0.25 * static_cast<double>(bytes.size() % 8);
  options.allMaterials = bytes.size() % 3 == 0;
  options.maxImageSide = 256;
  options.maxMemoryBytes = std::size_t{256} << 20;
  try {
    scenes::Scene scene = scenes::loadScene(file, options);
    InputResult result{.fault = findFault(scene)};
    if (!result.fault.empty()) return result;
    scenes::describeScene(scene);
    if (options.allMaterials && !scene.materials.empty()) scenes::makeMaterialBalls(std::move(scene));
    return result;
  } catch (const base::Error& error) {
    return refusedBy(error, file);
  }
}

InputResult loadEnvironmentBytes(const InputFolder& folder, std::span<const std::byte> bytes) {
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 4));
  const bool isExr = head == "\x76\x2f\x31\x01", isPfm = head.starts_with("PF") || head.starts_with("Pf");
  const std::string file = folder.write(isExr ? "input.exr" : isPfm ? "input.pfm" : "input.hdr", bytes);
  std::vector<std::string> warnings;
  try {
    const base::Image radiance = scenes::loadEnvironment(file, 0, warnings).radiance;
    InputResult result;
    if (radiance.channels != 3 || radiance.empty() || radiance.pixels.size() != 3 * radiance.pixelCount())
      result.fault = "an image of other than three channels";
    else if (!std::all_of(radiance.pixels.begin(), radiance.pixels.end(),
                          [](float v) { return std::isfinite(v) && v >= 0; }))
      result.fault = "radiance that is negative or not finite";
    return result;
  } catch (const base::Error& error) {
    return refusedBy(error, file);
  }
}

InputResult loadImageBytes(const InputFolder& folder, std::span<const std::byte> bytes) {
  constexpr base::ImageLimits kLimits{.maxSide = 1024, .maxBytes = std::size_t{64} << 20};
  const std::string file = folder.write("input.png", bytes); // told by its first bytes, whatever it is called
  InputResult result;
  const auto attempt = [&](const std::string& name, const auto& read) {
    try {
      if (const std::string fault = read(); !fault.empty()) result.fault = fault;
    } catch (const base::Error& error) {
      InputResult refused = refusedBy(error, name);
      if (result.fault.empty()) result = std::move(refused);
    }
  };
  const auto faultOf = [](const auto& image, std::size_t channels) -> std::string {
    return image.empty() || image.pixels.size() != channels * image.pixelCount() ? "an image of another size" : "";
  };
  attempt(file, [&] {
    const base::ImageFile picture = base::readImageFile(file, kLimits);
    const auto channels = static_cast<std::size_t>(picture.pixels.channels);
    if (picture.info.channelNames.size() != channels || picture.info.alphaChannel >= picture.pixels.channels)
      return std::string("other channels than there are pixels for");
    return faultOf(picture.pixels, channels);
  });
  attempt(file, [&] { return faultOf(base::readImage8(file, 4, kLimits), 4); });
  attempt("texture", [&] { return faultOf(base::decodeImage8(bytes, "texture", 3, kLimits), 3); });
  attempt(file, [&] {
    const auto ids = base::readIntegers(file, kLimits);
    return faultOf(ids, static_cast<std::size_t>(ids.channels));
  });
  return result;
}

} // namespace parity::tests
