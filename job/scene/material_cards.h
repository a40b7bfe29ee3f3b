// The cards of a scene's materials (report/material_card.h), and small pictures of their textures.
#pragma once

#include <string>
#include <vector>

#include "job/view/view_pictures.h"
#include "report/material_card.h"
#include "scenes/scene.h"

namespace parity::job {

struct MaterialCards {
  std::vector<report::MaterialCard> cards; // of the materials that a glob matches, in the scene's order
  std::vector<EncodedPicture> pictures;    // each once, by its content: images/texture-HASH.png
};

// scene: with the images as they were decoded. globs: none: all materials. pictures: false: none are made. Throws Error
// (exit 4) where a picture cannot be made.
MaterialCards describeMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs, bool pictures);

// Whether such a picture could have this name: "texture-0f3a...png".
bool isCardPicture(std::string_view name);

} // namespace parity::job
