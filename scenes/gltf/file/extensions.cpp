// Which extensions of glTF are read, and which are known not to be.
#include "scenes/gltf/file/extensions.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/names.h"

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 24> kSupported = {"EXT_mesh_gpu_instancing",
                                                         "EXT_meshopt_compression",
                                                         "EXT_texture_webp",
                                                         "KHR_draco_mesh_compression",
                                                         "KHR_lights_punctual",
                                                         "KHR_materials_anisotropy",
                                                         "KHR_materials_clearcoat",
                                                         "KHR_materials_diffuse_transmission",
                                                         "KHR_materials_dispersion",
                                                         "KHR_materials_emissive_strength",
                                                         "KHR_materials_ior",
                                                         "KHR_materials_iridescence",
                                                         "KHR_materials_pbrSpecularGlossiness",
                                                         "KHR_materials_sheen",
                                                         "KHR_materials_specular",
                                                         "KHR_materials_transmission",
                                                         "KHR_materials_unlit",
                                                         "KHR_materials_variants",
                                                         "KHR_materials_volume",
                                                         "KHR_mesh_quantization",
                                                         "KHR_texture_basisu",
                                                         "KHR_texture_transform",
                                                         "KHR_xmp", // say nothing of looks
                                                         "KHR_xmp_json_ld"};

struct NotModelled {
  std::string_view extension, name;
};
constexpr std::array<NotModelled, 2> kNotModelled = {
    {{"KHR_materials_subsurface", "subsurface"}, {"KHR_materials_volume_scatter", "volume scatter"}}};

// The names in a list that we do not read, each once, in order.
std::vector<std::string> listUnknown(const Json& document, const char* key) {
  std::vector<std::string> names;
  std::set<std::string> known;
  const auto list = document.find(key);
  if (list == document.end()) return names;
  for (const Json& entry : *list) {
    const std::string& name = entry.get_ref<const std::string&>();
    if (std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end() || !notModelledName(name).empty())
      continue;
    if (std::string clean = cleanName(name); known.insert(clean).second) names.push_back(std::move(clean));
  }
  return names;
}

} // namespace

std::string_view notModelledName(std::string_view extension) {
  const auto found = std::find_if(kNotModelled.begin(), kNotModelled.end(),
                                  [&](const NotModelled& each) { return each.extension == extension; });
  return found == kNotModelled.end() ? std::string_view() : found->name;
}

void checkGltfExtensions(const Json& document, Problems& problems, std::vector<std::string>& warnings) {
  for (const std::string& name : listUnknown(document, "extensionsRequired"))
    problems.add("/extensionsRequired", fmt::format("{} is not supported", name));
  constexpr std::size_t kMaxListed = 32;
  if (auto names = listUnknown(document, "extensionsUsed"); !names.empty()) {
    names.resize(std::min(names.size(), kMaxListed));
    warnings.push_back(fmt::format("extensions that are not supported are ignored: {}", fmt::join(names, ", ")));
  }
}

} // namespace parity::scenes
