#include "gpu/surface/coverage_builder.h"

#include <algorithm>
#include <tuple>

namespace parity::gpu {

CoverageBuilder::CoverageBuilder(const SceneBuffers& scene, int samples) : m_scene(scene), m_samples(samples) {
  for (const scenes::Material& material : scene.scene().materials) m_lists.push_back({material.name, {}, {}});
}

void CoverageBuilder::begin(const Tile& tile) {
  m_tile = tile;
  m_layers.clear();
}

void CoverageBuilder::lay(const Surface& surface, const ShadedSurface& shaded) {
  const std::vector<std::uint32_t>& materialOf = m_scene.materialOfInstance();
  m_width = surface.width;
  std::vector<Hit>& layer = m_layers.emplace_back();
  layer.reserve(surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i)
    layer.push_back({surface.pixels[i], materialOf[surface.instances[i]], surface.blended ? shaded.color[i].w : 1.f});
}

// Ascending by pixel, then material; a pair once.
std::vector<CoverageBuilder::Hit> CoverageBuilder::hitsOfSample() const {
  // Sorted by pixel by counting, the nearest layer first; then each pixel's few by material.
  const std::uint32_t first = m_tile.firstRow * m_width;
  std::vector<std::uint32_t> place(std::size_t{m_tile.rows} * m_width + 1, 0);
  for (const std::vector<Hit>& layer : m_layers)
    for (const Hit& hit : layer) ++place[hit.pixel - first + 1];
  for (std::size_t p = 1; p < place.size(); ++p) place[p] += place[p - 1];
  std::vector<Hit> sorted(place.back());
  std::vector<std::uint32_t> next(place.begin(), place.end() - 1);
  for (auto layer = m_layers.rbegin(); layer != m_layers.rend(); ++layer)
    for (const Hit& hit : *layer) sorted[next[hit.pixel - first]++] = hit;

  std::vector<Hit> hits;
  hits.reserve(sorted.size());
  for (std::size_t p = 0; p + 1 < place.size(); ++p) {
    const auto begin = sorted.begin() + place[p], end = sorted.begin() + place[p + 1];
    float throughput = 1;
    for (auto hit = begin; hit != end; ++hit) {
      const float opacity = hit->weight;
      hit->weight = throughput * opacity;
      throughput *= 1 - opacity;
    }
    std::stable_sort(begin, end, [](const Hit& a, const Hit& b) { return a.material < b.material; });
    for (auto hit = begin; hit != end; ++hit) {
      if (!(hit->weight > 0)) continue;
      if (!hits.empty() && hits.back().pixel == hit->pixel && hits.back().material == hit->material)
        hits.back().weight += hit->weight;
      else
        hits.push_back(*hit);
    }
  }
  return hits;
}

void CoverageBuilder::end() {
  const std::vector<Hit> hits = hitsOfSample();
  std::vector<Hit> merged;
  merged.reserve(std::max(m_sum.size(), hits.size()));
  auto a = m_sum.begin();
  auto b = hits.begin();
  const auto key = [](const Hit& h) { return std::tuple(h.pixel, h.material); };
  while (a != m_sum.end() || b != hits.end()) {
    if (b == hits.end() || (a != m_sum.end() && key(*a) < key(*b)))
      merged.push_back(*a++);
    else if (a == m_sum.end() || key(*b) < key(*a))
      merged.push_back(*b++);
    else {
      merged.push_back({a->pixel, a->material, a->weight + b->weight});
      ++a, ++b;
    }
  }
  m_sum = std::move(merged);
  if (++m_samplesOfTile == m_samples) finishTile();
}

void CoverageBuilder::finishTile() {
  for (const Hit& hit : m_sum) {
    base::PixelList& list = m_lists[hit.material];
    list.pixels.push_back(hit.pixel);
    list.weights.push_back(std::min(hit.weight / static_cast<float>(m_samples), 1.f));
  }
  m_sum.clear();
  m_samplesOfTile = 0;
}

std::vector<base::PixelList> CoverageBuilder::take() {
  for (base::PixelList& list : m_lists)
    if (std::all_of(list.weights.begin(), list.weights.end(), [](float w) { return w == 1.f; })) list.weights.clear();
  return std::move(m_lists);
}

} // namespace parity::gpu
