#include "bake/light/reflected_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parity::bake {

namespace {

constexpr int kRings = 2; // of texels beside a chart that bilinear reading may reach

// Fills what is not known and has a known neighbour by the mean of those.
void grow(std::vector<glm::vec3>& page, std::vector<bool>& known, int side) {
  std::vector<std::pair<std::size_t, glm::vec3>> found;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * side + x;
      if (known[at]) continue;
      glm::vec3 sum(0);
      int count = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, side - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, side - 1); ++u)
          if (const std::size_t n = static_cast<std::size_t>(v) * side + u; known[n]) {
            sum += page[n];
            ++count;
          }
      if (count > 0) found.emplace_back(at, sum / static_cast<float>(count));
    }
  for (const auto& [at, value] : found) {
    page[at] = value;
    known[at] = true;
  }
}

} // namespace

ReflectedLight::ReflectedLight(const Atlas& atlas, const TexelGrid& grid, const std::vector<glm::vec3>& irradiance,
                               const std::vector<bool>& isValid)
    : m_atlas(atlas), m_pages(static_cast<std::size_t>(atlas.pageCount)) {
  const auto side = static_cast<std::size_t>(atlas.pageSide);
  std::vector<std::vector<bool>> known(m_pages.size(), std::vector<bool>(side * side));
  for (auto& page : m_pages) page.resize(side * side, glm::vec3(0));
  for (std::size_t i = 0; i < grid.texels().size(); ++i) {
    if (!isValid[i]) continue;
    const Texel& texel = grid.texels()[i];
    m_pages[texel.page][texel.y * side + texel.x] = irradiance[i];
    known[texel.page][texel.y * side + texel.x] = true;
  }
  for (std::size_t p = 0; p < m_pages.size(); ++p)
    for (int ring = 0; ring < kRings; ++ring) grow(m_pages[p], known[p], atlas.pageSide);
}

glm::vec3 ReflectedLight::irradiance(const lighting::Visibility::Hit& hit) const {
  const scenes::LightmapUvs::Place& place = m_atlas.uvs.places[hit.instance];
  if (place.page < 0) return glm::vec3(0);
  const std::vector<glm::vec3>& page = m_pages[static_cast<std::size_t>(place.page)];
  const glm::vec2* corner = m_atlas.uvs.corners.data() + place.firstCorner + std::size_t{3} * hit.triangle;
  const glm::vec2 b = hit.barycentric;
  const glm::vec2 uv = (1 - b.x - b.y) * corner[0] + b.x * corner[1] + b.y * corner[2] + place.offset;
  const auto side = static_cast<float>(m_atlas.pageSide);
  const glm::vec2 at = glm::clamp(uv * side - 0.5f, glm::vec2(0), glm::vec2(side - 1));
  const int x0 = static_cast<int>(at.x), y0 = static_cast<int>(at.y);
  const int x1 = std::min(x0 + 1, m_atlas.pageSide - 1), y1 = std::min(y0 + 1, m_atlas.pageSide - 1);
  const float fx = at.x - static_cast<float>(x0), fy = at.y - static_cast<float>(y0);
  const auto texel = [&](int x, int y) { return page[static_cast<std::size_t>(y) * m_atlas.pageSide + x]; };
  return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), fx), glm::mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

} // namespace parity::bake
