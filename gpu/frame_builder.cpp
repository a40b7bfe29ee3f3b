#include "gpu/frame_builder.h"

#include <algorithm>

#include "base/parallel.h"
#include "shading/terms.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kGrain = 16384;

// target[pixel] = target[pixel] * keep + value * weight, over the entries of a surface.
void blendInto(base::Image& target, const Surface& surface, const std::vector<glm::vec4>& values,
               const auto& weightOf) {
  base::parallelFor(surface.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float* out = target.pixels.data() + std::size_t{surface.pixels[i]} * 3;
      const auto [keep, weight] = weightOf(i);
      for (int c = 0; c < 3; ++c) out[c] = (keep == 0 ? 0 : out[c] * keep) + values[i][c] * weight;
    }
  });
}

} // namespace

FrameBuilder::FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, bool terms,
                           const glm::vec3& background)
    : m_weight(1.f / static_cast<float>(samples)), m_background(background) {
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  m_frame.color = base::Image(w, h, 3);
  if (terms) m_frame.terms.assign(shading::kTermCount, base::Image(w, h, 3));
}

void FrameBuilder::add(const Surface& opaque, const ShadedSurface& opaqueShaded, const Surface* blended,
                       const ShadedSurface* blendedShaded, const Tile& tile) {
  // This sample's picture of the tile, then its share of the frame.
  const std::size_t first = std::size_t{tile.firstRow} * opaque.width, count = std::size_t{tile.rows} * opaque.width;
  const auto sampleInto = [&](base::Image& sum, const glm::vec3& behind, const std::vector<glm::vec4>* surface,
                              const std::vector<glm::vec4>* layer) {
    const bool single = m_weight == 1.f;
    base::Image sample;
    if (!single) sample = base::Image(sum.width, sum.height, 3);
    base::Image& target = single ? sum : sample;
    for (std::size_t p = first; p < first + count; ++p)
      for (int c = 0; c < 3; ++c) target.pixels[p * 3 + c] = behind[c];
    if (surface) blendInto(target, opaque, *surface, [](std::size_t) { return std::pair(0.f, 1.f); });
    if (layer)
      blendInto(target, *blended, *layer,
                [&](std::size_t i) { return std::pair(1 - blendedShaded->color[i].w, blendedShaded->color[i].w); });
    if (!single)
      for (std::size_t k = first * 3; k < (first + count) * 3; ++k) sum.pixels[k] += m_weight * sample.pixels[k];
  };
  const bool layered = blended != nullptr && blended->size() > 0;
  sampleInto(m_frame.color, m_background, opaque.size() ? &opaqueShaded.color : nullptr,
             layered ? &blendedShaded->color : nullptr);
  for (std::size_t t = 0; t < m_frame.terms.size(); ++t)
    sampleInto(m_frame.terms[t], glm::vec3(0), opaque.size() ? &opaqueShaded.terms[t] : nullptr,
               layered ? &blendedShaded->terms[t] : nullptr);
}

CoverageBuilder::CoverageBuilder(const SceneBuffers& scene, std::uint32_t width, std::uint32_t height, int samples)
    : m_scene(scene), m_width(width), m_height(height), m_weight(1.f / static_cast<float>(samples)) {}

void CoverageBuilder::add(const Surface& opaque, const Surface* blended, const ShadedSurface* blendedShaded) {
  const auto materialOf = [&](const Surface& s, std::size_t i) { return m_scene.materialOfInstance()[s.instances[i]]; };
  std::vector<float> through;
  if (blended && blended->size() > 0) {
    through.assign(std::size_t{m_width} * m_height, 1.f);
    for (std::size_t i = 0; i < blended->size(); ++i) {
      const float opacity = blendedShaded->color[i].w;
      through[blended->pixels[i]] = 1 - opacity;
      if (opacity > 0) m_hits.push_back({materialOf(*blended, i), blended->pixels[i], m_weight * opacity});
    }
  }
  for (std::size_t i = 0; i < opaque.size(); ++i) {
    const float weight = m_weight * (through.empty() ? 1.f : through[opaque.pixels[i]]);
    if (weight > 0) m_hits.push_back({materialOf(opaque, i), opaque.pixels[i], weight});
  }
}

std::vector<base::PixelList> CoverageBuilder::take() {
  // By material, then pixel, hits of one pixel in order of arrival; then hits of one pixel are added up.
  const auto& materials = m_scene.scene().materials;
  std::vector<std::vector<Hit>> byMaterial(materials.size());
  for (const Hit& hit : m_hits) byMaterial[hit.material].push_back(hit);
  m_hits.clear();
  std::vector<base::PixelList> lists(materials.size());
  base::parallelFor(materials.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      base::PixelList& list = lists[m];
      list.name = materials[m].name;
      std::vector<Hit>& hits = byMaterial[m];
      std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.pixel < b.pixel; });
      for (const Hit& hit : hits) {
        if (list.pixels.empty() || list.pixels.back() != hit.pixel) {
          list.pixels.push_back(hit.pixel);
          list.weights.push_back(0);
        }
        list.weights.back() = std::min(list.weights.back() + hit.weight, 1.f);
      }
      if (std::all_of(list.weights.begin(), list.weights.end(), [](float w) { return w == 1.f; })) list.weights.clear();
    }
  });
  return lists;
}

} // namespace parity::gpu
