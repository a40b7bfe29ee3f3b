#include "gpu/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "base/parallel.h"
#include "gpu/mip_taps.h"
#include "gpu/normal_variance.h"
#include "gpu/scene_buffers.h"
#include "gpu/shaders/interface.h"

namespace parity::gpu {

namespace {

// sRGB decode by code, and encode by a 16-bit linear index: a step is 0.05 codes at most.
struct SrgbTables {
  std::array<float, 256> decode;
  std::vector<std::uint8_t> encode;
  SrgbTables() : encode(65536) {
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      decode[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    for (int i = 0; i < 65536; ++i) {
      const double l = i / 65535.0;
      encode[i] =
          static_cast<std::uint8_t>(255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055) + 0.5);
    }
  }
};
const SrgbTables& srgbTables() {
  static const SrgbTables tables;
  return tables;
}

// The common case, both sides even: the mean of 2x2 texels.
base::Image8 halveEven(const base::Image8& source, bool srgb) {
  const SrgbTables& tables = srgbTables();
  base::Image8 target(source.width / 2, source.height / 2, 4);
  base::parallelFor(target.height, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const std::uint8_t* a = source.at(0, static_cast<int>(2 * y));
      const std::uint8_t* b = source.at(0, static_cast<int>(2 * y + 1));
      std::uint8_t* out = target.at(0, static_cast<int>(y));
      for (int x = 0; x < target.width; ++x, a += 8, b += 8, out += 4)
        for (int c = 0; c < 4; ++c) {
          if (srgb && c < 3) {
            const float sum =
                tables.decode[a[c]] + tables.decode[a[c + 4]] + tables.decode[b[c]] + tables.decode[b[c + 4]];
            out[c] = tables.encode[static_cast<int>(std::min(sum * 0.25f, 1.f) * 65535 + 0.5f)];
          } else {
            out[c] = static_cast<std::uint8_t>((a[c] + a[c + 4] + b[c] + b[c + 4] + 2) / 4);
          }
        }
    }
  });
  return target;
}

base::Image8 halve(const base::Image8& source, bool srgb) {
  if (source.width % 2 == 0 && source.height % 2 == 0) return halveEven(source, srgb);
  const SrgbTables& tables = srgbTables();
  base::Image8 target(std::max(source.width / 2, 1), std::max(source.height / 2, 1), 4);
  const std::vector<Taps> tapsX = makeTaps(source.width, target.width), tapsY = makeTaps(source.height, target.height);
  base::parallelFor(target.height, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < target.width; ++x) {
        std::array<float, 4> sum{};
        for (int ky = 0; ky < tapsY[y].count; ++ky)
          for (int kx = 0; kx < tapsX[x].count; ++kx) {
            const float weight = static_cast<float>(tapsY[y].weights[ky]) * static_cast<float>(tapsX[x].weights[kx]);
            const std::uint8_t* texel = source.at(tapsX[x].first + kx, tapsY[y].first + ky);
            for (int c = 0; c < 3; ++c)
              sum[c] += weight * (srgb ? tables.decode[texel[c]] : static_cast<float>(texel[c]));
            sum[3] += weight * static_cast<float>(texel[3]);
          }
        std::uint8_t* out = target.at(x, static_cast<int>(y));
        for (int c = 0; c < 3; ++c)
          out[c] = srgb ? tables.encode[static_cast<int>(std::min(sum[c], 1.f) * 65535 + 0.5f)]
                        : static_cast<std::uint8_t>(std::min(sum[c], 255.f) + 0.5f);
        out[3] = static_cast<std::uint8_t>(std::min(sum[3], 255.f) + 0.5f);
      }
  });
  return target;
}

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

std::array<const scenes::TextureSlot*, kSlotCount> slotsOf(const scenes::Material& m) {
  return {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,       &m.occlusionTexture,
          &m.emissiveTexture,  &m.specularTexture,          &m.specularColorTexture};
}

DeviceImage uploadImage(const Device& device, const std::vector<base::Image8>& mips, bool srgb) {
  std::vector<std::span<const std::byte>> spans;
  for (const base::Image8& mip : mips) spans.push_back(std::as_bytes(std::span{mip.pixels}));
  const DeviceImage::Shape shape{.format = srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                                 .width = static_cast<std::uint32_t>(mips.front().width),
                                 .height = static_cast<std::uint32_t>(mips.front().height),
                                 .mips = static_cast<std::uint32_t>(mips.size())};
  return DeviceImage(device, shape, spans);
}

} // namespace

Textures::Use Textures::useOf(int slot, bool normalVariance) {
  if (slot == kSlotBaseColor || slot == kSlotEmissive || slot == kSlotSpecularColor) return Use::color;
  return slot == kSlotNormal && normalVariance ? Use::normalVariance : Use::data;
}

std::vector<base::Image8> makeMips(const base::Image8& image, bool srgb) {
  std::vector<base::Image8> mips{image};
  while (mips.back().width > 1 || mips.back().height > 1) mips.push_back(halve(mips.back(), srgb));
  return mips;
}

std::size_t countSamplers(const scenes::Material& material, bool normalVariance) {
  std::vector<std::tuple<int, Textures::Use, scenes::Sampler>> pairs;
  const std::uint32_t read = classify(material).textures;
  for (int slot = 0; slot < kSlotCount; ++slot) {
    if ((read >> slot & 1u) == 0) continue;
    const scenes::TextureSlot& texture = *slotsOf(material)[slot];
    const std::tuple pair(texture.image, Textures::useOf(slot, normalVariance), texture.sampler);
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  }
  return pairs.size();
}

Textures::Textures(const Device& device, const scenes::Scene& scene, bool normalVariance)
    : m_device(device), m_scene(scene) {
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
  m_samplers.push_back(makeSampler(device, {}));
  for (const scenes::Sampler& sampler : samplers) m_samplers.push_back(makeSampler(device, sampler));
  const std::vector<base::Image8> white = {base::Image8(2, 2, 4, 255), base::Image8(1, 1, 4, 255)};
  m_whiteColor = uploadImage(device, white, true);
  m_whiteData = uploadImage(device, white, false);
}

void Textures::require(std::span<const Need> needs) const {
  std::set<int> missing;
  for (const Need& need : needs)
    for (int slot = 0; slot < kSlotCount; ++slot)
      if (const int image = m_sets[need.set][slot].image; (need.slots >> slot & 1u) != 0 && image >= 0)
        if (!m_images[image]) missing.insert(image);
  if (missing.empty()) return;
  const std::vector<int> list(missing.begin(), missing.end());
  std::vector<std::vector<base::Image8>> mips(list.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < list.size(); ++i)
    tasks.push_back([&, i] {
      const auto [image, use] = m_sources[list[i]];
      mips[i] = makeMips(m_scene.images[image].pixels, use == Use::color);
      if (use == Use::normalVariance) writeNormalVariance(mips[i]);
    });
  base::parallelInvoke(tasks);
  for (std::size_t i = 0; i < list.size(); ++i)
    m_images[list[i]] = uploadImage(m_device, mips[i], m_sources[list[i]].use == Use::color);
}

std::vector<vk::DescriptorImageInfo> Textures::bindings(const Need& need) const {
  require(std::span(&need, 1));
  std::vector<vk::DescriptorImageInfo> infos;
  for (int slot = 0; slot < kSlotCount; ++slot) {
    const Binding& binding = m_sets[need.set][slot];
    const bool isNeeded = (need.slots >> slot & 1u) != 0 && binding.image >= 0;
    const DeviceImage& white = useOf(slot, false) == Use::color ? m_whiteColor : m_whiteData;
    infos.emplace_back(*m_samplers[isNeeded ? binding.sampler : 0],
                       isNeeded ? m_images[binding.image]->view() : white.view(),
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
