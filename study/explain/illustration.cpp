#include "study/explain/illustration.h"

#include <map>
#include <utility>

#include "job/view/view_pictures.h"
#include "study/explain/error_mask.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {

namespace {

// Without effect on a material that has no texture to lay a mask over.
void addMask(Illustration& illustration, const SetRenderer& renderer, const scenes::Scene& scene, std::size_t material,
             std::vector<float> errors) {
  const MaskedTexture texture = maskedTexture(scene.materials[material]);
  if (!texture.slot) return;
  const std::vector<glm::vec2> places = renderer.texturePlaces(material, *texture.slot);
  if (places.empty()) return;
  const base::Image8& texels = scene.images[static_cast<std::size_t>(texture.slot->image)].pixels;
  const std::vector<float>& weights = renderer.coverage()[material].weights; // empty: all are 1
  for (std::size_t i = 0; i < weights.size(); ++i) errors[i] *= weights[i];
  TexelMask mask = maskOf(places, errors, texture.slot->sampler, texels.width, texels.height);
  illustration.input = texture.input;
  illustration.mask = std::move(mask.picture);
  illustration.texels = mask.texels;
}

} // namespace

void illustrate(SetRenderer& renderer, const scenes::Scene& scene, const job::Settings& settings,
                const std::vector<Switch>& switches, const std::vector<std::size_t>& places,
                const std::vector<std::vector<float>>& errors, std::vector<MaterialExplanation>& materials) {
  std::map<SwitchMask, std::vector<std::size_t>> advised; // each set is shaded once
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (materials[i].repair != 0) advised[materials[i].repair].push_back(i);
  for (const auto& [mask, of] : advised) {
    const base::Image8 picture = renderer.picture(withSwitches(settings, switches, mask));
    for (const std::size_t i : of)
      materials[i].illustration.advised =
          job::crop(picture, job::cropOf(renderer.coverage()[places[i]], picture.width, picture.height));
  }
  for (std::size_t i = 0; i < materials.size(); ++i)
    addMask(materials[i].illustration, renderer, scene, places[i], errors[i]);
}

} // namespace parity::explain
