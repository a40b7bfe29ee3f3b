#include "job/scene/material_cards.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
#include "base/text/glob.h"
#include "job/scene/texture_summary.h"

namespace parity::job {

namespace {

using report::CardInput, report::CardTexture, report::MaterialCard;
using scenes::AlphaMode, scenes::Material, scenes::TextureSlot;

constexpr std::string_view kPrefix = "texture-", kEnd = ".png";
constexpr std::size_t kThumbnailDigits = 16;
const TextureSlot kNoTexture;

// The shortest number that reads back as this float, as the file will have had it: 0.8, not 0.800000011920929.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

std::vector<double> valuesOf(const glm::vec3& color) {
  return {shortest(color.x), shortest(color.y), shortest(color.z)};
}

// A picture that is made once: of this image, these channels, as colour or as data.
struct PictureKey {
  int image;
  std::string channels;
  bool isColor;
  auto operator<=>(const PictureKey&) const = default;
};

// What an input reads of its texture, and what its figures are of.
struct Slot {
  const TextureSlot& texture;
  const char* channels;
  bool isColor = false;  // stored by the sRGB transfer function
  bool isNormal = false; // directions: its values have no range
  bool fromOne = false;  // the factor scales what is missing to 1: 1 + factor * (texel - 1)
  float atZero = 0;      // what a texel of 0 means, where one of 1 means the factor
};

class CardMaker {
public:
  CardMaker(const scenes::Scene& scene, std::vector<const Material*> chosen) : m_scene(scene) {
    // Which images are read, and which of their figures are wanted, is known once the inputs are listed.
    for (const Material* material : chosen) m_cards.push_back(describe(*material));
    measure();
  }

  MaterialCards take(bool pictures) {
    MaterialCards result;
    if (pictures) makePictures(result.pictures);
    result.cards = std::move(m_cards);
    return result;
  }

private:
  // A texture of a card whose figures and picture are to be filled in.
  struct Pending {
    std::size_t card, input;
    Slot slot;
  };

  MaterialCard describe(const Material& m) {
    MaterialCard card;
    card.name = m.name;
    const auto add = [&](const char* name, std::vector<double> value, const Slot& slot) {
      card.inputs.push_back({name, std::move(value), std::nullopt});
      if (slot.texture.present()) addTexture(card.inputs.back(), card.inputs.size() - 1, slot);
    };
    const TextureSlot &color = m.baseColorTexture, &packed = m.metallicRoughnessTexture;
    add("baseColor", valuesOf(glm::vec3(m.baseColor)), {color, "rgb", true});
    if (m.alphaMode != AlphaMode::opaque) add("opacity", {shortest(m.baseColor.w)}, {color, "a"});
    add("metallic", {shortest(m.metallic)}, {packed, "b"});
    add("roughness", {shortest(m.roughness)}, {packed, "g"});
    if (m.normalTexture.present())
      add("normal", {shortest(m.normalScale)}, {.texture = m.normalTexture, .channels = "rgb", .isNormal = true});
    if (m.occlusionTexture.present())
      add("occlusion", {shortest(m.occlusionStrength)},
          {.texture = m.occlusionTexture, .channels = "r", .fromOne = true});
    if (m.emissive != glm::vec3(0)) add("emissive", valuesOf(m.emissive), {m.emissiveTexture, "rgb", true});
    if (m.specular != 1 || m.specularTexture.present())
      add("specular", {shortest(m.specular)}, {m.specularTexture, "a"});
    if (m.specularColor != glm::vec3(1) || m.specularColorTexture.present())
      add("specularColor", valuesOf(m.specularColor), {m.specularColorTexture, "rgb", true});
    if (m.hasCoat()) {
      add("coat", {shortest(m.coat)}, {m.coatTexture, "r"});
      add("coatRoughness", {shortest(m.coatRoughness)}, {m.coatRoughnessTexture, "g"});
    }
    if (m.hasCoat() && m.coatNormalTexture.present())
      add("coatNormal", {shortest(m.coatNormalScale)},
          {.texture = m.coatNormalTexture, .channels = "rgb", .isNormal = true});
    if (m.hasSheen()) {
      add("sheenColor", valuesOf(m.sheenColor), {m.sheenColorTexture, "rgb", true});
      add("sheenRoughness", {shortest(m.sheenRoughness)}, {m.sheenRoughnessTexture, "a"});
    }
    if (m.hasAnisotropy()) {
      add("anisotropy", {shortest(m.anisotropy)}, {m.anisotropyTexture, "b"});
      add("anisotropyRotation", {shortest(m.anisotropyRotation)},
          {.texture = m.anisotropyTexture, .channels = "rgb", .isNormal = true});
    }
    if (m.hasIridescence()) {
      add("iridescence", {shortest(m.iridescence)}, {m.iridescenceTexture, "r"});
      add("iridescenceIor", {shortest(m.iridescenceIor)}, {kNoTexture, ""});
      add("iridescenceThickness", {shortest(m.iridescenceThicknessMax)},
          {.texture = m.iridescenceThicknessTexture, .channels = "g", .atZero = m.iridescenceThicknessMin});
    }
    if (m.hasTransmission()) add("transmission", {shortest(m.transmission)}, {m.transmissionTexture, "r"});
    if (m.hasDiffuseTransmission()) {
      add("diffuseTransmission", {shortest(m.diffuseTransmission)}, {m.diffuseTransmissionTexture, "a"});
      add("diffuseTransmissionColor", valuesOf(m.diffuseTransmissionColor),
          {m.diffuseTransmissionColorTexture, "rgb", true});
    }
    if (m.hasVolume()) {
      add("ior", {shortest(m.ior)}, {kNoTexture, ""});
      add("thickness", {shortest(m.thickness)}, {m.thicknessTexture, "g"});
    }
    if (m.hasVolume() && m.attenuationDistance > 0) {
      add("attenuationColor", valuesOf(m.attenuationColor), {kNoTexture, ""});
      add("attenuationDistance", {shortest(m.attenuationDistance)}, {kNoTexture, ""});
    }
    if (m.hasVolume() && m.dispersion > 0) add("dispersion", {shortest(m.dispersion)}, {kNoTexture, ""});
    constexpr const char* kModes[] = {"opaque", "mask", "blend"};
    card.alphaMode = kModes[static_cast<std::size_t>(m.alphaMode)];
    if (m.alphaMode == AlphaMode::mask) card.alphaCutoff = shortest(m.alphaCutoff);
    card.doubleSided = m.doubleSided;
    card.unlit = m.unlit;
    card.nonmetal = !m.unlit && m.isNonmetal();
    card.fullyRough = m.fullyRough;
    card.vertexColors = std::ranges::any_of(m_scene.meshes, [&](const scenes::Mesh& mesh) {
      return &m_scene.materials[mesh.material] == &m && !mesh.colors.empty();
    });
    card.f0 = valuesOf(m.dielectricF0());
    card.notModelled = m.notModelled;
    return card;
  }

  void addTexture(CardInput& input, std::size_t place, const Slot& slot) {
    const scenes::TextureImage& image = m_scene.images[static_cast<std::size_t>(slot.texture.image)];
    CardTexture& texture = input.texture.emplace();
    texture.name = image.name;
    texture.file = image.file;
    texture.channels = slot.channels;
    texture.texCoord = slot.texture.texCoord;
    if (image.pixels.empty()) return;
    texture.width = image.pixels.width;
    texture.height = image.pixels.height;
    m_pending.push_back({m_cards.size(), place, slot});
  }

  CardInput& inputOf(const Pending& pending) { return m_cards[pending.card].inputs[pending.input]; }

  // Each image once.
  void measure() {
    std::map<int, std::size_t> places;
    std::vector<const base::Image8*> images;
    for (const Pending& each : m_pending)
      if (!each.slot.isNormal && places.try_emplace(each.slot.texture.image, images.size()).second)
        images.push_back(&m_scene.images[static_cast<std::size_t>(each.slot.texture.image)].pixels);
    const std::vector<TextureSummary> summaries = summarise(images);
    for (const Pending& each : m_pending)
      if (!each.slot.isNormal) fill(inputOf(each), each.slot, summaries[places.at(each.slot.texture.image)]);
  }

  static void fill(CardInput& input, const Slot& slot, const TextureSummary& summary) {
    constexpr std::string_view kChannels = "rgba";
    const std::string_view channels = slot.channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const ValueRange range = rangeOf(summary.counts[kChannels.find(channels[c])], slot.isColor);
      const double factor = input.value[c];
      const double atZero = shortest(slot.atZero);
      const auto at = [&](double value) {
        return slot.fromOne ? 1 + factor * (value - 1) : atZero + (factor - atZero) * value;
      };
      const auto [least, most] = std::minmax({at(range.least), at(range.most)});
      input.texture->least.push_back(least);
      input.texture->most.push_back(most);
      input.texture->mean.push_back(at(range.mean));
    }
  }

  void makePictures(std::vector<EncodedPicture>& pictures) {
    const auto keyOf = [](const Slot& slot) { return PictureKey{slot.texture.image, slot.channels, slot.isColor}; };
    std::map<PictureKey, std::size_t> places;
    for (const Pending& each : m_pending) places.try_emplace(keyOf(each.slot), places.size());
    std::vector<EncodedPicture> made(places.size());
    const std::vector<std::pair<PictureKey, std::size_t>> all(places.begin(), places.end());
    base::parallelFor(all.size(), 1, [&](std::size_t i, std::size_t) {
      const auto& [key, place] = all[i];
      const base::Image8& image = m_scene.images[static_cast<std::size_t>(key.image)].pixels;
      std::vector<std::byte> bytes = base::encodeImage8("texture.png", makeThumbnail(image, key.channels, key.isColor));
      const std::string hash = base::Hasher().add(bytes).hex().substr(0, kThumbnailDigits);
      made[place] = {fmt::format("images/{}{}{}", kPrefix, hash, kEnd), std::move(bytes)};
    });
    for (const Pending& each : m_pending) inputOf(each).texture->picture = made[places.at(keyOf(each.slot))].file;
    std::set<std::string> names;
    for (EncodedPicture& picture : made)
      if (names.insert(picture.file).second) pictures.push_back(std::move(picture));
  }

  const scenes::Scene& m_scene;
  std::vector<MaterialCard> m_cards;
  std::vector<Pending> m_pending;
};

} // namespace

MaterialCards describeMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs, bool pictures) {
  std::vector<const Material*> chosen;
  for (const Material& material : scene.materials)
    if (globs.empty() ||
        std::ranges::any_of(globs, [&](const std::string& glob) { return base::matchesGlob(glob, material.name); }))
      chosen.push_back(&material);
  return CardMaker(scene, std::move(chosen)).take(pictures);
}

bool isCardPicture(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kEnd)) return false;
  const std::string_view hash = name.substr(kPrefix.size(), name.size() - kPrefix.size() - kEnd.size());
  return hash.size() == kThumbnailDigits && hash.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

} // namespace parity::job
