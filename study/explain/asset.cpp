#include "study/explain/asset.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "gpu/surface/material_class.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {

std::vector<AssetChange> assetChanges() {
  std::vector<AssetChange> changes;
  for (const double step : {0.05, 0.1, 0.2, 0.25})
    for (const char* quantity : {"roughness", "metallic", "base colour"})
      for (const double factor : {1 - step, 1 + step}) changes.push_back({quantity, factor, {}, 0});
  return changes;
}

std::optional<scenes::Material> withChange(const scenes::Material& material, AssetChange& change) {
  scenes::Material changed = material;
  const auto factor = static_cast<float>(change.factor);
  const auto scale = [&](float& value, const scenes::TextureSlot& texture) {
    if (!texture.present()) change.value = value * factor;
    const bool isPossible = value > 0 && value * factor <= 1;
    value *= factor;
    return isPossible;
  };
  if (change.quantity == "roughness") {
    if (!scale(changed.roughness, material.metallicRoughnessTexture)) return std::nullopt;
  } else if (change.quantity == "metallic") {
    if (!scale(changed.metallic, material.metallicRoughnessTexture)) return std::nullopt;
  } else {
    const glm::vec3 color = glm::vec3(material.baseColor) * factor;
    if (color == glm::vec3(0) || std::max({color.x, color.y, color.z}) > 1) return std::nullopt;
    changed.baseColor = glm::vec4(color, material.baseColor.w);
  }
  if (gpu::classify(changed) != gpu::classify(material)) return std::nullopt;
  return changed;
}

std::string describe(const AssetChange& change) {
  if (!change.value) return fmt::format("{} times {:g}", change.quantity, change.factor);
  return fmt::format("{} {:.3g} instead of {:.3g}", change.quantity, *change.value, *change.value / change.factor);
}

void suggestAssets(SetRenderer& renderer, const job::Settings& settings, const scenes::Scene& scene,
                   const std::vector<std::size_t>& places, std::vector<MaterialExplanation>& materials,
                   const std::function<void(double)>& tell) {
  using Program = SetRenderer::Program;
  const std::vector<AssetChange> changes = assetChanges();
  std::vector<std::size_t> open; // places in `materials`
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (materials[i].flip.front() > materials[i].limit) open.push_back(i);
  for (std::size_t k = 0; k < changes.size() && !open.empty(); ++k) {
    tell(static_cast<double>(k) / static_cast<double>(changes.size()));
    std::map<std::size_t, scenes::Material> changed; // by place in the scene
    std::map<std::size_t, AssetChange> tried;        // by place in `materials`
    for (const std::size_t i : open) {
      AssetChange change = changes[k];
      if (std::optional<scenes::Material> material = withChange(scene.materials[places[i]], change)) {
        changed.emplace(places[i], std::move(*material));
        tried.emplace(i, change);
      }
    }
    if (changed.empty()) continue;
    const std::vector<double> flip = renderer.flipOfAssets(settings, Program::wide, changed, places);
    for (auto& [i, change] : tried) {
      const std::size_t m = places[i];
      if (flip[i] > materials[i].limit) continue;
      change.flip = renderer.flipOfAssets(settings, Program::specialised, {{m, changed.at(m)}}, {m}).front();
      if (change.flip > materials[i].limit) continue;
      materials[i].asset = change;
      std::erase(open, i);
    }
  }
}

} // namespace parity::explain
