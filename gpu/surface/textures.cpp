#include "gpu/surface/textures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <set>
#include <utility>

#include "gpu/device/image_upload.h"
#include "gpu/shaders/interface.h"
#include "gpu/surface/mips.h"
#include "gpu/surface/normal_variance.h"
#include "gpu/surface/scene_buffers.h"

namespace parity::gpu {

namespace {

vk::raii::Sampler makeSampler(const Device& device, const scenes::Sampler& sampler) {
  const auto wrap = [](scenes::Wrap w) {
    return w == scenes::Wrap::repeat           ? vk::SamplerAddressMode::eRepeat
           : w == scenes::Wrap::mirroredRepeat ? vk::SamplerAddressMode::eMirroredRepeat
                                               : vk::SamplerAddressMode::eClampToEdge;
  };
  const auto filter = [](scenes::Filter f) {
    return f == scenes::Filter::linear ? vk::Filter::eLinear : vk::Filter::eNearest;
  };
  vk::SamplerCreateInfo info;
  info.setAddressModeU(wrap(sampler.wrapU)).setAddressModeV(wrap(sampler.wrapV));
  info.setMagFilter(filter(sampler.magFilter)).setMinFilter(filter(sampler.minFilter));
  info.setMipmapMode(sampler.mipFilter == scenes::Filter::linear ? vk::SamplerMipmapMode::eLinear
                                                                 : vk::SamplerMipmapMode::eNearest);
  // 0.25 reads the base level only, and still tells magnification from minification (the Vulkan specification's own
  // advice).
  info.setMaxLod(sampler.useMips ? VK_LOD_CLAMP_NONE : 0.25f);
  return vk::raii::Sampler(device.handle(), info);
}

DeviceImage makeImage(const Device& device, int width, int height, bool srgb) {
  return DeviceImage(device, {.format = srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                              .width = static_cast<std::uint32_t>(width),
                              .height = static_cast<std::uint32_t>(height),
                              .mips = static_cast<std::uint32_t>(
                                  std::bit_width(static_cast<std::uint32_t>(std::max(width, height))))});
}

// Mip by mip: in memory are two at a time at most, `base` too, which is over and done with when baseIsRead is called.
DeviceImage upload(const Device& device, const base::Image8& base, bool srgb, NormalVariance* variance,
                   const TextureCodec& codec, const std::function<void()>& baseIsRead) {
  DeviceImage image = makeImage(device, base.width, base.height, srgb);
  ImageUpload to(device, image);
  const auto write = [&](std::uint32_t mip, const base::Image8& pixels) {
    if (!codec) return to.write(mip, std::as_bytes(std::span{pixels.pixels}));
    const base::Image8 coded = codec(pixels, srgb);
    to.write(mip, std::as_bytes(std::span{coded.pixels}));
  };
  if (variance)
    write(0, withoutVariance(base));
  else
    write(0, base);
  base::Image8 finer;
  for (std::uint32_t mip = 1; mip < image.shape().mips; ++mip) {
    const base::Image8& source = mip == 1 ? base : finer;
    base::Image8 next = makeNextMip(source, srgb);
    if (variance) variance->writeNext(source, next);
    finer = std::move(next);
    if (mip == 1) baseIsRead();
    write(mip, finer);
  }
  if (image.shape().mips == 1) baseIsRead();
  to.finish();
  return image;
}

} // namespace

Textures::Use Textures::useOf(int slot, bool normalVariance) {
  if (slot == kSlotBaseColor || slot == kSlotEmissive || slot == kSlotSpecularColor || slot == kSlotSheenColor ||
      slot == kSlotDiffuseTransmissionColor)
    return Use::color;
  return (slot == kSlotNormal || slot == kSlotCoatNormal) && normalVariance ? Use::normalVariance : Use::data;
}

std::size_t countSamplers(const scenes::Material& material, bool normalVariance, std::uint32_t slots) {
  std::vector<std::tuple<int, Textures::Use, scenes::Sampler>> pairs;
  const std::uint32_t read = classify(material).textures & slots;
  for (int slot = 0; slot < kSlotCount; ++slot) {
    if ((read >> slot & 1u) == 0) continue;
    const scenes::TextureSlot& texture = *slotsOf(material)[slot];
    const std::tuple pair(texture.image, Textures::useOf(slot, normalVariance), texture.sampler);
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  }
  return pairs.size();
}

Textures::Textures(const Device& device, const scenes::Scene& scene, bool normalVariance, ImageDone onLastRead,
                   TextureCodec codec)
    : m_device(device), m_scene(scene), m_onLastRead(std::move(onLastRead)), m_codec(std::move(codec)) {
  std::vector<scenes::Sampler> samplers;
  std::map<std::vector<Binding>, std::uint32_t> sets;
  for (const scenes::Material& material : scene.materials) {
    std::vector<Binding> set(kSlotCount);
    for (int slot = 0; slot < kSlotCount; ++slot) {
      const scenes::TextureSlot& texture = *slotsOf(material)[slot];
      if (!texture.present()) continue;
      // An image that is read as colour and as data is uploaded once for each.
      const Source source{texture.image, useOf(slot, normalVariance)};
      const auto known = std::find(m_sources.begin(), m_sources.end(), source);
      set[slot].image = static_cast<int>(known - m_sources.begin());
      if (known == m_sources.end()) m_sources.push_back(source);
      const auto found = std::find(samplers.begin(), samplers.end(), texture.sampler);
      set[slot].sampler = static_cast<int>(found - samplers.begin()) + 1;
      if (found == samplers.end()) samplers.push_back(texture.sampler);
    }
    const auto [entry, isNew] = sets.try_emplace(set, static_cast<std::uint32_t>(m_sets.size()));
    if (isNew) m_sets.push_back(set);
    m_setOfMaterial.push_back(entry->second);
  }
  m_images.resize(m_sources.size());
  countReads();
  m_samplers.push_back(makeSampler(device, {}));
  for (const scenes::Sampler& sampler : samplers) m_samplers.push_back(makeSampler(device, sampler));
  makeWhites();
}

void Textures::makeWhites() {
  std::vector<std::tuple<bool, int, int>> kinds; // of m_whites: is colour, sides
  for (int slot = 0; slot < kSlotCount; ++slot) {
    std::tuple kind(useOf(slot, false) == Use::color, 2, 2);
    Binding& binding = m_whiteOfSlot[slot];
    for (const std::vector<Binding>& set : m_sets) {
      if (set[slot].image < 0) continue;
      const base::Image8& like = m_scene.images[m_sources[set[slot].image].image].pixels;
      if (like.pixels.empty()) continue; // nothing reads it
      const auto sideLike = [](int side) { return static_cast<int>(standInSide(static_cast<std::uint32_t>(side))); };
      std::get<1>(kind) = sideLike(like.width), std::get<2>(kind) = sideLike(like.height);
      binding.sampler = set[slot].sampler;
      break;
    }
    const auto known = std::ranges::find(kinds, kind);
    binding.image = static_cast<int>(known - kinds.begin());
    if (known != kinds.end()) continue;
    kinds.push_back(kind);
    const auto [isColor, width, height] = kind;
    m_whites.push_back(upload(m_device, base::Image8(width, height, 4, 255), isColor, nullptr, {}, [] {}));
  }
}

void Textures::require(std::span<const Need> needs) const {
  std::set<int> missing;
  for (const Need& need : needs)
    for (int slot = 0; slot < kSlotCount; ++slot)
      if (const int image = m_sets[need.set][slot].image; (need.slots >> slot & 1u) != 0 && image >= 0)
        if (!m_images[image]) missing.insert(image);
  for (const int each : missing) {
    const auto [image, use] = m_sources[each];
    assert(!m_scene.images[image].pixels.empty() && "is used by a material that no object has");
    NormalVariance variance;
    m_images[each] = upload(m_device, m_scene.images[image].pixels, use == Use::color,
                            use == Use::normalVariance ? &variance : nullptr, m_codec, [&] { countAsRead(image); });
  }
}

// Of what is placed in the scene, and of that only what its class reads.
void Textures::countReads() {
  std::set<int> read; // into m_sources
  for (const scenes::Instance& instance : m_scene.instances) {
    const std::uint32_t material = m_scene.meshes[instance.mesh].material;
    std::uint32_t slots = classify(m_scene.materials[material]).textures;
    if (m_scene.materials[material].alphaMode != scenes::AlphaMode::opaque) slots |= 1u << kSlotBaseColor;
    for (int slot = 0; slot < kSlotCount; ++slot)
      if (const int source = m_sets[m_setOfMaterial[material]][slot].image; (slots >> slot & 1u) != 0 && source >= 0)
        read.insert(source);
  }
  m_unreadSources.resize(m_scene.images.size());
  for (const int source : read) ++m_unreadSources[m_sources[source].image];
  if (m_onLastRead)
    for (std::size_t image = 0; image < m_unreadSources.size(); ++image)
      if (m_unreadSources[image] == 0) m_onLastRead(static_cast<int>(image));
}

void Textures::countAsRead(int image) const {
  if (--m_unreadSources[image] == 0 && m_onLastRead) m_onLastRead(image);
}

std::vector<vk::DescriptorImageInfo> Textures::bindings(const Need& need) const {
  require(std::span(&need, 1));
  std::vector<vk::DescriptorImageInfo> infos;
  for (int slot = 0; slot < kSlotCount; ++slot) {
    const Binding& own = m_sets[need.set][slot];
    const bool isNeeded = (need.slots >> slot & 1u) != 0 && own.image >= 0;
    const Binding& binding = isNeeded ? own : m_whiteOfSlot[slot];
    infos.emplace_back(*m_samplers[binding.sampler], (isNeeded ? *m_images[own.image] : m_whites[binding.image]).view(),
                       vk::ImageLayout::eShaderReadOnlyOptimal);
  }
  return infos;
}

std::size_t Textures::uploadedCount() const {
  return static_cast<std::size_t>(
      std::count_if(m_images.begin(), m_images.end(), [](const auto& image) { return image.has_value(); }));
}

std::size_t Textures::varianceCount() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < m_images.size(); ++i)
    count += m_images[i].has_value() && m_sources[i].use == Use::normalVariance;
  return count;
}

} // namespace parity::gpu
