// Dilation ring by ring.
#include "bake/encode/dilation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace parity::bake {
namespace {

// The texels that one texel is filled from.
struct Sources {
  std::array<std::size_t, 8> texels{};
  std::size_t count = 0;
};

// Rings around what is filled already; `fill(texel, sources)` is called once for each texel that becomes so.
template <typename Fill> class Rings {
public:
  Rings(base::BasicImage<std::uint32_t>& owner, const base::Image8& invalid, const Fill& fill)
      : m_owner(owner), m_fill(fill), m_filled(owner.pixels.size()) {
    assert(invalid.empty() || invalid.pixels.size() == owner.pixels.size());
    for (std::size_t i = 0; i < m_filled.size(); ++i)
      m_filled[i] = owner.pixels[i] != kNoInstance && (invalid.empty() || invalid.pixels[i] == 0);
  }

  // Texels that have an owner, from others of it.
  void fillOwned() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < m_filled.size(); ++i)
      if (!m_filled[i] && m_owner.pixels[i] != kNoInstance) open.push_back(i);
    while (fillRing(open)) {
    }
    for (const std::size_t i : open) m_filled[i] = true;
  }

  void fillFree(int rings) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < m_filled.size(); ++i)
      if (!m_filled[i]) open.push_back(i);
    for (int ring = 0; ring < rings && fillRing(open); ++ring) {
    }
  }

private:
  // Fills what of `open` has filled neighbours, and keeps the rest there. False where there was nothing.
  bool fillRing(std::vector<std::size_t>& open) {
    std::vector<std::size_t> rest, filled;
    std::vector<std::uint32_t> owners;
    for (const std::size_t texel : open) {
      const Sources sources = sourcesOf(texel);
      if (sources.count == 0) {
        rest.push_back(texel);
        continue;
      }
      m_fill(texel, sources);
      filled.push_back(texel);
      owners.push_back(m_owner.pixels[sources.texels[0]]);
    }
    for (std::size_t i = 0; i < filled.size(); ++i) {
      m_filled[filled[i]] = true;
      m_owner.pixels[filled[i]] = owners[i];
    }
    open = std::move(rest);
    return !filled.empty();
  }

  Sources sourcesOf(std::size_t texel) const {
    const int width = m_owner.width, height = m_owner.height;
    const int x = static_cast<int>(texel % static_cast<std::size_t>(width));
    const int y = static_cast<int>(texel / static_cast<std::size_t>(width));
    std::uint32_t wanted = m_owner.pixels[texel];
    const bool isFree = wanted == kNoInstance;
    Sources sources;
    for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
        const std::size_t source = static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + u;
        const std::uint32_t owner = m_owner.pixels[source];
        if (!m_filled[source] || (isFree ? owner > wanted : owner != wanted)) continue;
        if (owner < wanted) sources.count = 0;
        wanted = owner;
        sources.texels[sources.count++] = source;
      }
    return sources;
  }

  base::BasicImage<std::uint32_t>& m_owner;
  const Fill& m_fill;
  std::vector<bool> m_filled;
};

template <typename Fill>
void fillAll(base::BasicImage<std::uint32_t>& owner, int texels, const base::Image8& invalid, const Fill& fill) {
  Rings<Fill> rings(owner, invalid, fill);
  rings.fillOwned();
  rings.fillFree(texels);
}

// The mean of one channel.
template <typename T> float meanOf(const base::BasicImage<T>& image, const Sources& sources, std::size_t channel) {
  float sum = 0;
  for (std::size_t i = 0; i < sources.count; ++i)
    sum += static_cast<float>(image.pixels[sources.texels[i] * static_cast<std::size_t>(image.channels) + channel]);
  return sum / static_cast<float>(sources.count);
}

void fillMean(base::Image& image, std::size_t texel, const Sources& sources) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t c = 0; c < channels; ++c) image.pixels[texel * channels + c] = meanOf(image, sources, c);
}

void fillNormal(base::Image& image, std::size_t texel, const Sources& sources) {
  fillMean(image, texel, sources);
  float* normal = image.pixels.data() + 3 * texel;
  const float length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  // Opposite normals have no mean; double-sided texels have none at all.
  if (length < 1e-3f)
    std::copy_n(image.pixels.data() + 3 * sources.texels[0], 3, normal);
  else
    for (int c = 0; c < 3; ++c) normal[c] /= length;
}

} // namespace

void dilate(LightmapPage& page, int texels, const base::Image8& invalid) {
  fillAll(page.owner, texels, invalid, [&](std::size_t texel, const Sources& sources) {
    fillMean(page.irradiance, texel, sources);
    fillMean(page.sh, texel, sources);
    fillNormal(page.normal, texel, sources);
  });
}

void dilate(base::Image8& values, base::BasicImage<std::uint32_t>& owner, int texels, const base::Image8& invalid) {
  const auto channels = static_cast<std::size_t>(values.channels);
  fillAll(owner, texels, invalid, [&](std::size_t texel, const Sources& sources) {
    for (std::size_t c = 0; c < channels; ++c)
      values.pixels[texel * channels + c] = static_cast<std::uint8_t>(std::lround(meanOf(values, sources, c)));
  });
}

} // namespace parity::bake
