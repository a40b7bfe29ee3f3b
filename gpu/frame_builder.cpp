#include "gpu/frame_builder.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "shading/terms.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kGrain = 16384;

// plane = value * weight + plane * keep at the pixels of a surface, in the target's numbers where there is one; the
// plane begins at the tile's first pixel. weightsOf: entry -> (keep, weight).
void composite(float* plane, std::size_t firstPixel, const Surface& surface, const std::vector<glm::vec4>& values,
               const auto& weightsOf, const TargetCodec* target) {
  base::parallelFor(surface.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float* out = plane + (surface.pixels[i] - firstPixel) * 3;
      const auto [keep, weight] = weightsOf(i);
      // What is hidden wholly is replaced, not multiplied by 0: it may be NaN.
      glm::vec3 value(values[i]);
      if (target) value = target->write(value);
      for (int c = 0; c < 3; ++c) value[c] = (keep == 0 ? 0 : out[c] * keep) + value[c] * weight;
      if (target) value = target->store(value);
      for (int c = 0; c < 3; ++c) out[c] = value[c];
    }
  });
}

} // namespace

FrameBuilder::FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, bool terms,
                           const glm::vec3& background, const std::optional<TargetCodec>& target)
    : m_samples(samples), m_background(target ? target->store(target->write(background)) : background),
      m_target(target) {
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  m_frame.color = base::Image(w, h, 3);
  if (terms) m_frame.terms.assign(shading::kTermCount, base::Image(w, h, 3));
}

void FrameBuilder::add(const Surface& opaque, const ShadedSurface& opaqueShaded, const Surface* blended,
                       const ShadedSurface* blendedShaded, const Tile& tile) {
  assert((blended == nullptr) == (blendedShaded == nullptr));
  const std::size_t firstPixel = std::size_t{tile.firstRow} * opaque.width,
                    count = std::size_t{tile.rows} * opaque.width;
  const bool layered = blended != nullptr && blended->size() > 0;
  m_scratch.resize(count * 3);

  const auto addSample = [&](base::Image& sum, const glm::vec3& behind, const TargetCodec* target,
                             const auto& planeOf) {
    for (std::size_t p = 0; p < count; ++p)
      for (int c = 0; c < 3; ++c) m_scratch[p * 3 + c] = behind[c];
    if (opaque.size() > 0)
      composite(
          m_scratch.data(), firstPixel, opaque, planeOf(opaqueShaded), [](std::size_t) { return std::pair(0.f, 1.f); },
          target);
    if (layered)
      composite(
          m_scratch.data(), firstPixel, *blended, planeOf(*blendedShaded),
          [&](std::size_t i) {
            const float opacity = blendedShaded->color[i].w;
            return std::pair(1 - opacity, blendedShaded->premultiplied ? 1.f : opacity);
          },
          target);
    float* out = sum.pixels.data() + firstPixel * 3;
    for (std::size_t k = 0; k < count * 3; ++k) out[k] += m_scratch[k];
  };
  addSample(
      m_frame.color, m_background, m_target ? &*m_target : nullptr,
      [](const ShadedSurface& s) -> const auto& { return s.color; });
  for (std::size_t t = 0; t < m_frame.terms.size(); ++t)
    addSample(
        m_frame.terms[t], glm::vec3(0), nullptr, [t](const ShadedSurface& s) -> const auto& { return s.terms[t]; });
}

base::Frame FrameBuilder::take() {
  const auto divide = [&](base::Image& image) {
    for (float& value : image.pixels) value /= static_cast<float>(m_samples);
  };
  if (m_samples > 1) {
    divide(m_frame.color);
    for (base::Image& term : m_frame.terms) divide(term);
  }
  if (m_target)
    base::parallelFor(m_frame.color.pixelCount(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (float* p = m_frame.color.pixels.data() + 3 * begin; p != m_frame.color.pixels.data() + 3 * end; p += 3) {
        const glm::vec3 light = m_target->read(m_target->store({p[0], p[1], p[2]}));
        for (int c = 0; c < 3; ++c) p[c] = light[c];
      }
    });
  return std::move(m_frame);
}

CoverageBuilder::CoverageBuilder(const SceneBuffers& scene, int samples) : m_scene(scene), m_samples(samples) {
  for (const scenes::Material& material : scene.scene().materials) m_lists.push_back({material.name, {}, {}});
}

std::vector<CoverageBuilder::Hit> CoverageBuilder::hitsOf(const Surface& opaque, const Surface* blended,
                                                          const ShadedSurface* blendedShaded, const Tile& tile) const {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Seen {
    std::uint32_t opaque = kNone, layer = kNone;
    float opacity = 0;
  };
  const std::uint32_t first = tile.firstRow * opaque.width;
  std::vector<Seen> seen(std::size_t{tile.rows} * opaque.width);
  const std::vector<std::uint32_t>& materialOf = m_scene.materialOfInstance();
  for (std::size_t i = 0; i < opaque.size(); ++i)
    seen[opaque.pixels[i] - first].opaque = materialOf[opaque.instances[i]];
  if (blended)
    for (std::size_t i = 0; i < blended->size(); ++i) {
      Seen& s = seen[blended->pixels[i] - first];
      s.layer = materialOf[blended->instances[i]];
      s.opacity = blendedShaded->color[i].w;
    }
  std::vector<Hit> hits;
  for (std::size_t p = 0; p < seen.size(); ++p) {
    const Seen& s = seen[p];
    const auto pixel = static_cast<std::uint32_t>(p) + first;
    const Hit behind{pixel, s.opaque, 1 - s.opacity}, layer{pixel, s.layer, s.opacity};
    const bool hasBehind = s.opaque != kNone && behind.weight > 0, hasLayer = s.layer != kNone && layer.weight > 0;
    if (hasBehind && (!hasLayer || s.opaque < s.layer)) hits.push_back(behind);
    if (hasLayer) hits.push_back(layer);
    if (hasBehind && hasLayer && s.opaque > s.layer) hits.push_back(behind);
  }
  return hits;
}

void CoverageBuilder::add(const Surface& opaque, const Surface* blended, const ShadedSurface* blendedShaded,
                          const Tile& tile) {
  assert((blended == nullptr) == (blendedShaded == nullptr));
  const std::vector<Hit> hits = hitsOf(opaque, blended, blendedShaded, tile);
  std::vector<Hit> merged;
  merged.reserve(std::max(m_tile.size(), hits.size()));
  auto a = m_tile.begin();
  auto b = hits.begin();
  const auto key = [](const Hit& h) { return std::tuple(h.pixel, h.material); };
  while (a != m_tile.end() || b != hits.end()) {
    if (b == hits.end() || (a != m_tile.end() && key(*a) < key(*b)))
      merged.push_back(*a++);
    else if (a == m_tile.end() || key(*b) < key(*a))
      merged.push_back(*b++);
    else {
      merged.push_back({a->pixel, a->material, a->weight + b->weight});
      ++a, ++b;
    }
  }
  m_tile = std::move(merged);
  if (++m_samplesOfTile == m_samples) finishTile();
}

void CoverageBuilder::finishTile() {
  for (const Hit& hit : m_tile) {
    base::PixelList& list = m_lists[hit.material];
    list.pixels.push_back(hit.pixel);
    list.weights.push_back(std::min(hit.weight / static_cast<float>(m_samples), 1.f));
  }
  m_tile.clear();
  m_samplesOfTile = 0;
}

std::vector<base::PixelList> CoverageBuilder::take() {
  for (base::PixelList& list : m_lists)
    if (std::all_of(list.weights.begin(), list.weights.end(), [](float w) { return w == 1.f; })) list.weights.clear();
  return std::move(m_lists);
}

} // namespace parity::gpu
