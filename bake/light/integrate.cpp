#include "bake/light/integrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "bake/atlas/texel_points.h"
#include "bake/light/direct_light.h"
#include "bake/light/group_gather.h"
#include "bake/stages.h"
#include "reference/sampling.h"

namespace parity::bake {

namespace {

// Of a texel in the passes whose result is only looked up: the last pass averages over many of them.
constexpr std::uint32_t kCoarseSamples = 256;
constexpr double kDarkShare = 0.1; // of the mean irradiance: what is darker need not be more exact than that

// Samples of a texel after those that all have: at most so many times as many, and at least this part of them.
constexpr int kMostMore = 3, kLeastMore = 4;

// Passes, for the seeds.
enum Pass : std::uint32_t { kValidity = 1, kFinal, kMore, kFirstCoarse };

struct Direct {
  TexelLight inLightmap;              // all lights but the sun
  glm::vec3 all{0.f}, allOfBack{0.f}; // irradiance, the sun's too
  std::uint16_t valid = 0, sunLit = 0, facesSun = 0, unused = 0;
};
struct Coarse {
  glm::vec3 irradiance{0.f}, back{0.f};
};
class Integrator {
public:
  Integrator(const scenes::Scene& scene, const Atlas& atlas, const TexelGrid& grid, const BakeLights& lights,
             const IntegrateOptions& options, const Control& control)
      : m_scene(scene), m_atlas(atlas), m_grid(grid), m_lights(lights), m_options(options), m_stages(control),
        m_visibility(scene), m_surfaces(scene), m_emitters(scene, m_surfaces) {
    if (lights.environment) {
      m_sky = std::make_unique<reference::EnvironmentSampler>(*lights.environment,
                                                              reference::EnvironmentSampler::Tables::forSamples);
      if (m_sky->isBlack()) m_sky.reset();
    }
    m_samplesSky = m_sky && isUneven(*m_sky);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) m_hasTwoSides |= m_surfaces.isDoubleSided(i);
  }

  StaticLight run() {
    const std::size_t count = m_grid.texels().size();
    std::vector<Direct> direct(count);
    m_stages.run("direct", "direct light", 0, 0.05, std::span(direct),
                 [&](std::size_t i, std::uint64_t& rays) { return directAt(i, rays); });
    std::vector<bool> isValid(count);
    for (std::size_t i = 0; i < count; ++i) isValid[i] = direct[i].valid != 0;

    const bool shines = m_sky || !m_emitters.empty();
    const bool reflects = m_options.bounces > 0 && (shines || !m_lights.lights.empty());
    StaticLight result;
    result.gathered.resize(count);
    result.error.resize(count);
    result.samples.resize(count);
    if (shines || reflects) gather(direct, isValid, shines, result);

    for (std::size_t i = 0; i < count; ++i) {
      result.direct.push_back(direct[i].inLightmap);
      result.valid.push_back(direct[i].valid);
      result.sunLit.push_back(direct[i].sunLit);
      result.facesSun.push_back(direct[i].facesSun);
    }
    result.rays = m_stages.rays();
    return result;
  }

private:
  std::uint32_t seedOf(std::size_t i, std::uint32_t pass) const {
    using reference::hashCombine;
    const Texel& t = m_grid.texels()[i];
    const std::uint32_t place = hashCombine(t.page, static_cast<std::uint32_t>(t.y) << 16 | t.x);
    return hashCombine(place, hashCombine(m_options.seed, pass));
  }

  Direct directAt(std::size_t i, std::uint64_t& rays) const {
    const Texel& texel = m_grid.texels()[i];
    const TexelPoints all = pointsOf(m_grid, texel);
    Direct result;
    result.valid = findValid(all, m_visibility, m_surfaces, 0.5 / m_options.texelsPerMetre, seedOf(i, kValidity), rays);
    const bool bothSides = m_surfaces.isDoubleSided(texel.instance);
    LightSum sun, others;
    int valid = 0;
    for (std::size_t k = 0; k < all.count; ++k) {
      const SurfacePoint& point = all.points[k];
      if (bothSides || facesSun(point)) {
        result.facesSun = static_cast<std::uint16_t>(result.facesSun | 1 << all.subTexel[k]);
        if (isSunLit(point, rays)) result.sunLit = static_cast<std::uint16_t>(result.sunLit | 1 << all.subTexel[k]);
      }
      if ((result.valid & 1 << all.subTexel[k]) == 0) continue;
      ++valid;
      for (std::size_t l = 0; l < m_lights.lights.size(); ++l) {
        ++rays;
        addLight(m_lights.lights[l], point, bothSides, m_visibility, l == m_lights.sun ? sun : others);
      }
    }
    if (valid == 0) return result;
    result.inLightmap = others.times(1.0 / valid);
    const TexelLight ofSun = sun.times(1.0 / valid);
    result.all = result.inLightmap.irradiance + ofSun.irradiance;
    result.allOfBack = result.inLightmap.back + ofSun.back;
    return result;
  }

  // Where it does not, shading says enough: an edge of a shadow there would be seen beside it, and so would light. What
  // is double-sided always has a side that does.
  bool facesSun(const SurfacePoint& point) const {
    return m_lights.sun && glm::dot(glm::dvec3(point.geometric), towardsSun()) > 0;
  }
  bool isSunLit(const SurfacePoint& point, std::uint64_t& rays) const {
    if (!m_lights.sun) return true;
    const glm::dvec3 n(point.geometric);
    ++rays;
    return !m_visibility.isOccluded(m_visibility.leaveSurface(point.position, facesSun(point) ? n : -n), towardsSun());
  }
  glm::dvec3 towardsSun() const { return -glm::dvec3(m_lights.lights[*m_lights.sun].direction); }

  // Jacobi's iteration of the diffuse light: each pass gathers what the one before has left on the surfaces.
  void gather(const std::vector<Direct>& direct, const std::vector<bool>& isValid, bool shines, StaticLight& result) {
    const std::size_t count = direct.size();
    const int passes = m_options.bounces + 1;
    std::vector<glm::vec3> fronts(count), backs(count);
    for (std::size_t i = 0; i < count; ++i) {
      fronts[i] = direct[i].all;
      backs[i] = direct[i].allOfBack;
    }
    std::vector<Coarse> coarse(count);
    std::unique_ptr<ReflectedLight> byFronts, byBacks;
    for (int pass = 0; pass < passes - 1; ++pass) {
      if (pass > 0 || shines) gatherCoarsely(surroundings(byFronts.get(), byBacks.get()), direct, pass, coarse);
      for (std::size_t i = 0; i < count; ++i) {
        fronts[i] = direct[i].all + coarse[i].irradiance;
        backs[i] = direct[i].allOfBack + coarse[i].back;
      }
      byFronts = std::make_unique<ReflectedLight>(m_atlas, m_grid, fronts, isValid);
      if (m_hasTwoSides) byBacks = std::make_unique<ReflectedLight>(m_atlas, m_grid, backs, isValid);
    }
    const auto around = surroundings(byFronts.get(), byBacks.get());
    // How bright the scene is, for what is too dark to matter: of the last pass, or of one for nothing else.
    if (passes == 1) gatherCoarsely(around, direct, 0, coarse);
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i)
      mean += lightmapLuminance(coarse[i].irradiance + direct[i].inLightmap.irradiance);
    mean /= static_cast<double>(std::max<std::size_t>(std::ranges::count(isValid, true), 1));
    gatherFinally(around, direct, kDarkShare * mean, result);
  }

  // First each group by itself. What the groups have left of all samples then goes to the texels that had not enough.
  void gatherFinally(const Surroundings& around, const std::vector<Direct>& direct, double floor, StaticLight& result) {
    const TexelGroups groups(m_grid);
    std::vector<std::uint32_t> all(groups.count());
    std::iota(all.begin(), all.end(), 0u);
    gatherGroups("final", {0.3, 0.8}, around, direct, groups, all, {m_options.error, m_options.maxSamples, floor},
                 result);

    const auto isUnfinished = [&](std::uint32_t i) { return result.error[i] > m_options.error; };
    std::int64_t left = 0, unfinished = 0;
    for (std::uint32_t i = 0; i < direct.size(); ++i) {
      if (result.samples[i] > 0) left += std::int64_t{m_options.maxSamples} - result.samples[i];
      unfinished += isUnfinished(i) ? 1 : 0;
    }
    if (unfinished == 0) return;
    const auto more = static_cast<int>(std::min(left / unfinished, std::int64_t{kMostMore} * m_options.maxSamples));
    if (more < m_options.maxSamples / kLeastMore) return;
    std::erase_if(all, [&](std::uint32_t g) { return std::ranges::none_of(groups[g], isUnfinished); });
    gatherGroups("more", {0.8, 1}, around, direct, groups, all, {m_options.error, more, floor}, result);
  }

  // Those texels of some groups that are not exact enough.
  void gatherGroups(const std::string& name, glm::dvec2 done, const Surroundings& around,
                    const std::vector<Direct>& direct, const TexelGroups& groups,
                    const std::vector<std::uint32_t>& some, const GroupOptions& options, StaticLight& result) {
    std::vector<GatheredGroup> gathered(some.size());
    m_stages.run(
        name, "gathering", done.x, done.y, std::span(gathered),
        [&](std::size_t k, std::uint64_t& rays) {
          std::vector<GroupTexel> texels;
          for (const std::uint32_t i : groups[some[k]]) {
            const Gathered before{result.gathered[i], result.error[i], result.samples[i]};
            texels.push_back(groupTexelAt(direct[i], i, before, options.error));
          }
          return gatherGroup(around, texels, options, rays);
        },
        TexelGroups::kMost);
    for (std::size_t k = 0; k < some.size(); ++k)
      for (std::size_t j = 0; j < groups[some[k]].size(); ++j) {
        const std::uint32_t i = groups[some[k]][j];
        result.gathered[i] = gathered[k][j].light;
        result.error[i] = gathered[k][j].error;
        result.samples[i] = gathered[k][j].samples;
      }
  }

  void gatherCoarsely(const Surroundings& around, const std::vector<Direct>& direct, int pass,
                      std::vector<Coarse>& coarse) {
    const double passes = m_options.bounces + 1, from = 0.05 + 0.25 * pass / passes,
                 to = 0.05 + 0.25 * (pass + 1) / passes;
    m_stages.run("coarse " + std::to_string(pass), "bounce " + std::to_string(pass), from, to, std::span(coarse),
                 [&](std::size_t i, std::uint64_t& rays) { return coarseAt(around, direct[i], i, pass, rays); });
  }

  Surroundings surroundings(const ReflectedLight* byFronts, const ReflectedLight* byBacks) const {
    return {m_visibility, m_surfaces, m_emitters, m_sky.get(), m_samplesSky, byFronts, byBacks};
  }

  Coarse coarseAt(const Surroundings& around, const Direct& direct, std::size_t i, int pass,
                  std::uint64_t& rays) const {
    const TexelPoints points = pointsOf(m_grid, m_grid.texels()[i], direct.valid);
    if (points.count == 0) return {};
    const auto seen = std::span(points.points).first(points.count);
    const GatherPoints texel{seen, m_surfaces.isDoubleSided(m_grid.texels()[i].instance)};
    std::array<glm::vec3, kFactor * kFactor> normals;
    std::ranges::transform(seen, normals.begin(), &SurfacePoint::normal);
    const Directions directions{std::span(normals).first(points.count), texel.bothSides};
    const DirectionGuide even;
    const GatherWay way{directions, even};
    const std::uint32_t seed = seedOf(i, kFirstCoarse + static_cast<std::uint32_t>(pass));
    LightSum sum;
    for (std::uint32_t s = 0; s < kCoarseSamples; ++s) sum += gatherSample(around, texel, way, s, seed, rays).sum;
    const TexelLight mean = sum.times(1.0 / kCoarseSamples);
    return {mean.irradiance, mean.back};
  }

  GroupTexel groupTexelAt(const Direct& direct, std::uint32_t i, const Gathered& before, double wanted) const {
    const Texel& texel = m_grid.texels()[i];
    GroupTexel result;
    result.before = before;
    if (before.samples > 0 && before.error <= wanted) return result;
    result.points = pointsOf(m_grid, texel, direct.valid);
    result.bothSides = m_surfaces.isDoubleSided(texel.instance);
    result.known = lightmapLuminance(direct.inLightmap.irradiance + direct.inLightmap.back);
    result.seed = seedOf(i, before.samples > 0 ? kMore : kFinal);
    return result;
  }

  const scenes::Scene& m_scene;
  const Atlas& m_atlas;
  const TexelGrid& m_grid;
  const BakeLights& m_lights;
  const IntegrateOptions& m_options;
  Stages m_stages;
  lighting::Visibility m_visibility;
  lighting::SurfaceLight m_surfaces;
  lighting::Emitters m_emitters;
  std::unique_ptr<reference::EnvironmentSampler> m_sky;
  bool m_samplesSky = false, m_hasTwoSides = false;
};

glm::vec3 meanNormal(const TexelPoints& points) {
  glm::vec3 sum(0);
  for (std::size_t k = 0; k < points.count; ++k) sum += points.points[k].normal;
  // They may point everywhere.
  return glm::dot(sum, sum) > 1e-12f ? glm::normalize(sum) : points.count > 0 ? points.points[0].normal : sum;
}

bool isTwoSided(const scenes::Scene& scene, std::uint32_t instance) {
  return scene.materials[scene.meshes[scene.instances[instance].mesh].material].doubleSided;
}

// Irradiance that the SH's mean radiance would give, in the colour of what reaches both sides.
glm::vec3 fromEverywhere(const TexelLight& light) {
  const glm::dvec3 both(light.irradiance + light.back);
  const double luminance = lightmapLuminance(both);
  return luminance > 0 ? glm::vec3(both * (std::numbers::pi * kY0 * light.sh.x / luminance)) : glm::vec3(0);
}

} // namespace

StaticLight integrate(const scenes::Scene& scene, const Atlas& atlas, const TexelGrid& grid, const BakeLights& lights,
                      const IntegrateOptions& options, const Control& control) {
  return Integrator(scene, atlas, grid, lights, options, control).run();
}

std::vector<IntegratedPage> makePages(const scenes::Scene& scene, const Atlas& atlas, const TexelGrid& grid,
                                      const StaticLight& light, bool withDirect) {
  const int side = atlas.pageSide;
  std::vector<IntegratedPage> pages(static_cast<std::size_t>(atlas.pageCount));
  for (IntegratedPage& page : pages)
    page = {{{side, side, 1, kNoInstance}, {side, side, 3}, {side, side, 4}, {side, side, 3}}, {side, side, 1}};
  for (std::size_t i = 0; i < grid.texels().size(); ++i) {
    const Texel& texel = grid.texels()[i];
    auto& [page, invalid] = pages[texel.page];
    *page.owner.at(texel.x, texel.y) = texel.instance;
    const bool isValid = light.valid[i] != 0;
    *invalid.at(texel.x, texel.y) = isValid ? 0 : 1;
    TexelLight sum = light.gathered[i];
    if (withDirect) sum += light.direct[i];
    glm::vec3 normal(0);
    if (isTwoSided(scene, texel.instance))
      sum.irradiance = fromEverywhere(sum);
    else
      normal = meanNormal(pointsOf(grid, texel, isValid ? light.valid[i] : std::uint16_t{0xffff}));
    for (int c = 0; c < 3; ++c) {
      page.irradiance.at(texel.x, texel.y)[c] = sum.irradiance[c];
      page.normal.at(texel.x, texel.y)[c] = normal[c];
    }
    for (int c = 0; c < 4; ++c) page.sh.at(texel.x, texel.y)[c] = sum.sh[c];
  }
  return pages;
}

} // namespace parity::bake
