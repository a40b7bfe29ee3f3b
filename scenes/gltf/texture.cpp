// Texture slots of a glTF file: sampler, uv set, uv transform.
#include "scenes/gltf/texture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

Wrap wrapOf(const GltfDocument& document, int mode, const std::string& place) {
  switch (mode) {
  case TINYGLTF_TEXTURE_WRAP_REPEAT:
    return Wrap::repeat;
  case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
    return Wrap::mirroredRepeat;
  case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
    return Wrap::clampToEdge;
  default:
    throw document.error(place, fmt::format("{} is not a wrap mode", mode));
  }
}

Sampler samplerOf(const GltfDocument& document, int index) {
  Sampler sampler; // a texture without one repeats and is filtered as the program likes
  if (index < 0) return sampler;
  const tinygltf::Sampler& source = document.model.samplers[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("/samplers/{}", index);
  sampler.wrapU = wrapOf(document, source.wrapS, place + "/wrapS");
  sampler.wrapV = wrapOf(document, source.wrapT, place + "/wrapT");
  switch (source.magFilter) {
  case -1:
  case TINYGLTF_TEXTURE_FILTER_LINEAR:
    sampler.magFilter = Filter::linear;
    break;
  case TINYGLTF_TEXTURE_FILTER_NEAREST:
    sampler.magFilter = Filter::nearest;
    break;
  default:
    throw document.error(place + "/magFilter", fmt::format("{} is not a filter", source.magFilter));
  }
  const auto setMin = [&](Filter min, Filter mip, bool useMips) {
    sampler.minFilter = min;
    sampler.mipFilter = mip;
    sampler.useMips = useMips;
  };
  switch (source.minFilter) {
  case -1:
  case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
    setMin(Filter::linear, Filter::linear, true);
    break;
  case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
    setMin(Filter::linear, Filter::nearest, true);
    break;
  case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
    setMin(Filter::nearest, Filter::linear, true);
    break;
  case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
    setMin(Filter::nearest, Filter::nearest, true);
    break;
  case TINYGLTF_TEXTURE_FILTER_LINEAR:
    setMin(Filter::linear, Filter::nearest, false);
    break;
  case TINYGLTF_TEXTURE_FILTER_NEAREST:
    setMin(Filter::nearest, Filter::nearest, false);
    break;
  default:
    throw document.error(place + "/minFilter", fmt::format("{} is not a filter", source.minFilter));
  }
  return sampler;
}

// The image that a texture shows: KTX 2 or WebP where it has one, as the extensions ask for; else PNG or JPEG, which is
// then for programs that read neither.
int imageOf(const GltfDocument& document, const tinygltf::Texture& texture, int index, const std::string& place) {
  for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp"})
    if (const auto found = texture.extensions.find(extension); found != texture.extensions.end())
      return found->second.Get("source").GetNumberAsInt();
  if (texture.source >= 0) return texture.source;
  throw document.error(fmt::format("{} (/textures/{})", place, index), "has no image");
}

glm::dvec2 pairOf(const tinygltf::Value& value, const char* key, glm::dvec2 otherwise) {
  if (!value.Has(key)) return otherwise;
  const tinygltf::Value& pair = value.Get(key);
  return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

} // namespace

std::array<float, 6> uvTransform(glm::dvec2 offset, double rotation, glm::dvec2 scale) {
  const double c = std::cos(rotation), s = std::sin(rotation);
  return {static_cast<float>(c * scale.x),  static_cast<float>(s * scale.y), static_cast<float>(offset.x),
          static_cast<float>(-s * scale.x), static_cast<float>(c * scale.y), static_cast<float>(offset.y)};
}

std::optional<UvTransformParts> splitUvTransform(const std::array<float, 6>& uv) {
  // Columns (cos, -sin) * scale.x and (sin, cos) * scale.y.
  const glm::dvec2 first(uv[0], uv[3]), second(uv[1], uv[4]);
  UvTransformParts parts{.offset = {uv[2], uv[5]}, .scale = {first.x, second.y}, .rotation = 0};
  if (first.y == 0 && second.x == 0) return parts; // exactly; mirrored by a negative scale
  parts.rotation = first != glm::dvec2(0) ? std::atan2(-first.y, first.x) : std::atan2(second.x, second.y);
  const double c = std::cos(parts.rotation), s = std::sin(parts.rotation);
  parts.scale = {c * first.x - s * first.y, s * second.x + c * second.y};
  const std::array<float, 6> again = uvTransform(parts.offset, parts.rotation, parts.scale);
  constexpr float kRounding = 1e-5f; // of 32 bits
  const float limit = kRounding * static_cast<float>(std::max(glm::length(first), glm::length(second)));
  for (std::size_t i = 0; i < uv.size(); ++i)
    if (!(std::abs(again[i] - uv[i]) <= limit) && i % 3 != 2) return std::nullopt;
  return parts;
}

TextureSlot readTextureSlot(const GltfDocument& document, int texture, int texCoord,
                            const tinygltf::ExtensionMap& extensions, const std::string& place) {
  TextureSlot slot;
  if (texture < 0) return slot;
  const tinygltf::Texture& source = document.model.textures[static_cast<std::size_t>(texture)];
  slot.image = document.firstOfImage[static_cast<std::size_t>(imageOf(document, source, texture, place))];
  slot.sampler = samplerOf(document, source.sampler);
  slot.texCoord = texCoord;
  if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
    const tinygltf::Value& transform = found->second;
    const double rotation = transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0.0;
    slot.uvTransform = uvTransform(pairOf(transform, "offset", {0, 0}), rotation, pairOf(transform, "scale", {1, 1}));
    if (transform.Has("texCoord")) slot.texCoord = transform.Get("texCoord").GetNumberAsInt();
  }
  return slot;
}

TextureSlot readTextureSlot(const GltfDocument& document, const tinygltf::Value& info, const std::string& place) {
  tinygltf::ExtensionMap extensions;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
    extensions["KHR_texture_transform"] = info.Get("extensions").Get("KHR_texture_transform");
  return readTextureSlot(document, info.Get("index").GetNumberAsInt(),
                         info.Has("texCoord") ? info.Get("texCoord").GetNumberAsInt() : 0, extensions, place);
}

} // namespace parity::scenes
