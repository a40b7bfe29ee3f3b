#include "gpu/surface/material_swap.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "base/gathered.h"
#include "base/parallel.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kSwapGrain = 16384;

// How a surface's entry lies over what is behind: out = value * weight + behind * keep.
struct Over {
  float keep, weight;
};

Over overOf(const Surface& surface, const ShadedSurface& shaded, std::size_t entry) {
  if (!surface.blended) return {0, 1};
  const float opacity = shaded.color[entry].w;
  return {1 - opacity, shaded.premultiplied ? 1.f : opacity};
}

glm::vec3 compose(const glm::vec3& value, const glm::vec3& behind, const Over& over) {
  // What is hidden wholly is replaced, not multiplied by 0: it may be NaN.
  return over.keep == 0 ? value * over.weight : value * over.weight + behind * over.keep;
}

// The same by the test path's target. What is opaque becomes what the target returns for it. A target that is displayed
// blends in its own numbers; what it makes of the picture behind alone is taken off again, as that is not the
// material's doing. A float target rounds so little that its blending is taken as exact.
glm::vec3 composeByTarget(const glm::vec3& value, const glm::vec3& behind, const Over& over,
                          const TargetCodec* target) {
  const auto returned = [&](const glm::vec3& written) { return target->read(target->store(written)); };
  if (!target) return compose(value, behind, over);
  if (over.keep == 0) return returned(target->write(value) * over.weight);
  if (!target->isDisplayed()) return compose(value, behind, over);
  const glm::vec3 written = target->write(behind);
  return returned(target->write(value) * over.weight + written * over.keep) + (behind - returned(written)) * over.keep;
}

} // namespace

SwapBuilder::SwapBuilder(const std::vector<std::uint32_t>& materialOf, std::size_t materials, std::uint32_t width,
                         int samples, std::vector<glm::vec3> background, const std::optional<TargetCodec>& target,
                         std::vector<char> wanted)
    : m_materialOf(materialOf), m_width(width), m_samples(samples), m_background(std::move(background)),
      m_target(target), m_wanted(std::move(wanted)), m_planes(m_background.size()), m_materials(materials) {
  m_wanted.resize(m_materials.size(), m_wanted.empty() ? 1 : 0);
}

void SwapBuilder::begin(const Tile& tile, std::size_t layers) {
  const std::size_t pixels = tile.rows * m_width;
  m_firstPixel = static_cast<std::uint32_t>(tile.firstRow * m_width);
  m_entries.clear();
  m_colors.clear();
  m_head.assign(pixels, kNone);
  m_base.resize(m_samples > 1 || layers > 1 ? pixels * m_planes : 0);
  m_isBare.assign(pixels, m_samples == 1 ? 1 : 0);
  if (m_samples == 1) return;
  for (std::size_t i = 0; i < pixels; ++i) std::ranges::copy(m_background, &m_base[i * m_planes]);
  if (m_samplesOfTile > 0) return;
  m_baseSums.assign(m_base.size(), glm::vec3(0.f));
  m_exactSums.assign(m_base.size(), glm::dvec3(0));
}

void SwapBuilder::lay(const Surface& surface, const ShadedSurface& reference, const ShadedSurface& test,
                      std::span<const SwapPlane> planes) {
  // Each entry of the surface is of another pixel, and has its own place for a new entry of the chain.
  const std::size_t first = m_entries.size();
  m_entries.resize(first + surface.size());
  m_colors.resize(m_entries.size() * m_planes);
  const bool hasBase = !m_base.empty();
  assert((hasBase || first == 0) && "begin() was told of one layer");
  base::parallelFor(surface.size(), kSwapGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t place = surface.pixels[i] - m_firstPixel;
      const std::uint32_t material = m_materialOf[surface.instances[i]];
      const Over ofReference = overOf(surface, reference, i), ofTest = overOf(surface, test, i);
      const auto composeTest = [&](std::size_t plane, const glm::vec3& behind) {
        return composeByTarget(glm::vec3(planes[plane].test[i]), behind, ofTest, m_target ? &*m_target : nullptr);
      };
      glm::vec3* behind = hasBase ? &m_base[place * m_planes] : m_background.data();
      if (hasBase && m_isBare[place] != 0) {
        m_isBare[place] = 0;
        std::ranges::copy(m_background, behind);
      }
      bool found = false;
      for (std::uint32_t e = m_head[place]; e != kNone; e = m_entries[e].next) {
        const bool isOwn = m_entries[e].material == material;
        found |= isOwn;
        m_entries[e].whole &= isOwn;
        for (std::size_t p = 0; p < m_planes; ++p) {
          glm::vec3& color = m_colors[e * m_planes + p];
          color = isOwn ? composeTest(p, color) : compose(glm::vec3(planes[p].reference[i]), color, ofReference);
        }
      }
      if (!found && m_wanted[material] != 0) {
        const std::size_t e = first + i;
        m_entries[e] = {material, m_head[place], !surface.blended};
        m_head[place] = static_cast<std::uint32_t>(e);
        for (std::size_t p = 0; p < m_planes; ++p) m_colors[e * m_planes + p] = composeTest(p, behind[p]);
      }
      for (std::size_t p = 0; hasBase && p < m_planes; ++p)
        behind[p] = compose(glm::vec3(planes[p].reference[i]), behind[p], ofReference);
    }
  });
}

// Merges the entries of a pixel into the tile's sums; `old` walks over those.
void SwapBuilder::addToSums(const std::vector<std::uint32_t>& chain, std::uint32_t place, std::size_t& old,
                            std::vector<Sum>& merged, std::vector<glm::dvec3>& differences) const {
  const auto keep = [&] {
    const auto begin = m_differences.begin() + static_cast<std::ptrdiff_t>(old * m_planes);
    merged.push_back(m_sums[old++]);
    differences.insert(differences.end(), begin, begin + static_cast<std::ptrdiff_t>(m_planes));
  };
  const auto key = [](const Sum& s) { return std::tuple(s.pixel, s.material); };
  for (const std::uint32_t e : chain) {
    const Sum sum{m_firstPixel + place, m_entries[e].material, m_entries[e].whole ? 1u : 0u};
    while (old < m_sums.size() && key(m_sums[old]) < key(sum)) keep();
    if (old < m_sums.size() && key(m_sums[old]) == key(sum)) {
      keep();
      merged.back().whole += sum.whole;
    } else {
      merged.push_back(sum);
      differences.insert(differences.end(), m_planes, glm::dvec3(0));
    }
    for (std::size_t p = 0; p < m_planes; ++p)
      differences[differences.size() - m_planes + p] +=
          glm::dvec3(m_colors[e * m_planes + p]) - glm::dvec3(m_base[place * m_planes + p]);
  }
}

// There is nothing to add up.
void SwapBuilder::keepOnlySample() {
  for (std::uint32_t place = 0; place < m_head.size(); ++place)
    for (std::uint32_t e = m_head[place]; e != kNone; e = m_entries[e].next) {
      Material& material = m_materials[m_entries[e].material];
      m_entries[e].place = static_cast<std::uint32_t>(material.pixels.size());
      material.pixels.push_back(m_firstPixel + place);
      material.whole.push_back(m_entries[e].whole ? 1 : 0);
    }
  for (Material& material : m_materials) material.colors.resize(material.pixels.size() * m_planes);
  base::parallelFor(m_head.size(), kSwapGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place)
      for (std::uint32_t e = m_head[place]; e != kNone; e = m_entries[e].next)
        std::copy_n(&m_colors[e * m_planes], m_planes,
                    &m_materials[m_entries[e].material].colors[m_entries[e].place * m_planes]);
  });
}

void SwapBuilder::end() {
  if (m_samples == 1) {
    keepOnlySample();
    m_colors = base::RawVector<glm::vec3>(); // take() then uses this memory for its pictures
    m_base = base::RawVector<glm::vec3>();
    return;
  }
  std::vector<Sum> merged;
  std::vector<glm::dvec3> differences;
  std::vector<std::uint32_t> chain;
  std::size_t old = 0;
  for (std::uint32_t place = 0; place < m_head.size(); ++place) {
    chain.clear();
    for (std::uint32_t e = m_head[place]; e != kNone; e = m_entries[e].next) chain.push_back(e);
    std::ranges::sort(chain, {}, [&](std::uint32_t e) { return m_entries[e].material; });
    addToSums(chain, place, old, merged, differences);
  }
  for (std::size_t i = old * m_planes; i < m_differences.size(); ++i) differences.push_back(m_differences[i]);
  merged.insert(merged.end(), m_sums.begin() + static_cast<std::ptrdiff_t>(old), m_sums.end());
  m_sums = std::move(merged);
  m_differences = std::move(differences);
  for (std::size_t i = 0; i < m_base.size(); ++i) {
    m_baseSums[i] += m_base[i];
    m_exactSums[i] += glm::dvec3(m_base[i]);
  }
  if (++m_samplesOfTile == m_samples) finishTile();
}

void SwapBuilder::finishTile() {
  for (std::size_t i = 0; i < m_sums.size(); ++i) {
    Material& material = m_materials[m_sums[i].material];
    material.pixels.push_back(m_sums[i].pixel);
    material.whole.push_back(m_sums[i].whole == static_cast<std::uint32_t>(m_samples) ? 1 : 0);
    for (std::size_t p = 0; p < m_planes; ++p) {
      const std::size_t place = (m_sums[i].pixel - m_firstPixel) * m_planes + p;
      const glm::dvec3 difference = m_differences[i * m_planes + p];
      glm::vec3 color = m_baseSums[place] / static_cast<float>(m_samples);
      // Where nothing differs the swapped picture is the base picture, bit by bit.
      for (int c = 0; c < 3; ++c)
        if (!(difference[c] == 0)) color[c] = static_cast<float>((m_exactSums[place][c] + difference[c]) / m_samples);
      material.colors.push_back(color);
    }
  }
  m_sums.clear();
  m_differences.clear();
  m_samplesOfTile = 0;
}

std::vector<SwappedPixels> SwapBuilder::take(const std::vector<base::PixelList>& coverage,
                                             std::span<const base::Image* const> finished) {
  std::vector<SwappedPixels> result(coverage.size());
  base::parallelFor(coverage.size(), 1, [&](std::size_t m, std::size_t) {
    const std::vector<std::uint32_t>& pixels = coverage[m].pixels;
    Material material = std::move(m_materials[m]);
    if (pixels.empty() || m_wanted[m] == 0) return;
    SwappedPixels& out = result[m];
    out.planes.assign(m_planes, base::makeGathered<float>(pixels.size(), 3));
    // What opaque layers hide has an entry, but no place in the coverage.
    std::vector<std::uint32_t> places(pixels.size());
    for (std::size_t i = 0, at = 0; i < pixels.size(); ++i) {
      while (material.pixels.at(at) < pixels[i]) ++at;
      places[i] = static_cast<std::uint32_t>(at);
      if (material.whole[at] != 0) out.whole.push_back(static_cast<std::uint32_t>(i));
    }
    base::parallelFor(pixels.size(), kSwapGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = 0; p < m_planes; ++p)
        for (std::size_t i = begin; i < end; ++i) {
          float* color = &out.planes[p].pixels[3 * i];
          if (material.whole[places[i]] != 0 && !finished.empty())
            std::copy_n(&finished[p]->pixels[3 * std::size_t{pixels[i]}], 3, color);
          else
            for (int c = 0; c < 3; ++c) color[c] = material.colors[places[i] * m_planes + p][c];
        }
    });
  });
  return result;
}

} // namespace parity::gpu
