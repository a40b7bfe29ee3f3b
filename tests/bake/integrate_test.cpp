// The integrator against closed forms.
#include "bake/light/integrate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "bake/bake_scenes.h"
#include "bake/encode/sun_pages.h"
#include "base/error.h"
#include "base/expect_error.h"
#include "base/parallel.h"
#include "base/temp_folder.h"

namespace parity::bake {
namespace {

using namespace tests;
using std::numbers::pi;

TEST(Integrate, PlaneUnderAPointLight) {
  scenes::Scene scene;
  addObject(scene, square(2), matte("floor", 0.5f));
  const glm::vec3 candela(30, 20, 10);
  const Baked baked(scene, {{pointLight({0.3f, 1.5f, -0.2f}, candela)}, {}, {}});
  int count = 0;
  baked.forWhole([&](const SurfacePoint& point, const TexelLight& direct, const TexelLight& gathered) {
    const glm::dvec3 way = glm::dvec3(0.3, 1.5, -0.2) - glm::dvec3(point.position);
    const double d = glm::length(way), E = way.y / (d * d * d);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(direct.irradiance[c], candela[c] * E, 0.01 * candela[c] * E);
    EXPECT_EQ(gathered.irradiance, glm::vec3(0)); // the floor sees nothing that reflects
    // One direction: the SH of order 1 are those of a delta.
    const glm::vec3 l1(direct.sh.y, direct.sh.z, direct.sh.w);
    EXPECT_NEAR(glm::length(l1) / direct.sh.x, std::sqrt(3.0), 0.01);
    EXPECT_GT(glm::dot(glm::normalize(l1), glm::vec3(way / d)), 0.999f);
    ++count;
  });
  EXPECT_GE(count, 900); // 4 m at 8 texels a metre
}

TEST(Integrate, PlaneUnderAnEvenSky) {
  scenes::Scene scene;
  addObject(scene, square(1), matte("floor", 0.5f));
  const glm::vec3 radiance(0.5f, 1, 2);
  const Baked baked(scene, {{}, {}, evenSky(radiance)});
  int count = 0;
  baked.forWhole([&](const SurfacePoint&, const TexelLight& direct, const TexelLight& gathered) {
    EXPECT_EQ(direct.irradiance, glm::vec3(0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(gathered.irradiance[c], pi * radiance[c], 0.01 * pi * radiance[c]);
    const double luminance = lightmapLuminance(radiance);
    EXPECT_NEAR(gathered.sh.x, 2 * pi * kY0 * luminance, 0.04 * 2 * pi * kY0 * luminance);
    EXPECT_NEAR(gathered.sh.z, pi * kY1 * luminance, 0.04 * pi * kY1 * luminance); // along the normal, +Y
    EXPECT_NEAR(gathered.sh.y, 0, 0.15 * luminance);
    EXPECT_NEAR(gathered.sh.w, 0, 0.15 * luminance);
    ++count;
  });
  EXPECT_GE(count, 200);
}

// Every wall emits and reflects: radiance Le (1 + rho + rho^2 + ...) everywhere.
TEST(Integrate, Furnace) {
  constexpr float kAlbedo = 0.6f, kEmitted = 2;
  for (const int bounces : {0, 1, 3, 24}) {
    scenes::Scene scene;
    addObject(scene, insideOfBox(1), matte("walls", kAlbedo, kEmitted));
    const Baked baked(scene, {}, {.bounces = bounces, .error = 0.005}, 4);
    const double E = pi * kEmitted * (1 - std::pow(kAlbedo, bounces + 1)) / (1 - kAlbedo);
    double sum = 0;
    int count = 0;
    baked.forWhole([&](const SurfacePoint&, const TexelLight&, const TexelLight& gathered) {
      EXPECT_NEAR(gathered.irradiance.y, E, 0.01 * E) << bounces;
      sum += gathered.irradiance.y;
      ++count;
    });
    ASSERT_GE(count, 6 * 36) << bounces;
    EXPECT_NEAR(sum / count, E, 0.0025 * E) << bounces;
    if (bounces == 24) {
      EXPECT_NEAR(sum / count, pi * kEmitted / (1 - kAlbedo), 0.003 * pi * kEmitted / (1 - kAlbedo));
    }
  }
}

// The wanted error is what 19 of 20 texels are within.
TEST(Integrate, ErrorIsWhatItSays) {
  scenes::Scene scene;
  addObject(scene, insideOfBox(1), matte("walls", 0, 2));
  const Baked baked(scene, {}, {.bounces = 0, .error = 0.01}, 8);
  const double E = pi * 2;
  int within = 0, count = 0;
  baked.forWhole([&](const SurfacePoint&, const TexelLight&, const TexelLight& gathered) {
    within += std::abs(gathered.irradiance.y - E) <= 0.01 * E;
    ++count;
  });
  EXPECT_GE(count, 6 * 200);
  EXPECT_GE(within, 0.94 * count);
}

TEST(Integrate, SmallEmissivePanelAboveAFloor) {
  scenes::Scene scene;
  addObject(scene, square(1.5f), matte("floor", 0));
  const glm::mat4 above =
      glm::rotate(glm::translate(glm::mat4(1.f), glm::vec3(0.2f, 0.7f, 0)), glm::radians(180.f), glm::vec3(1, 0, 0));
  addObject(scene, square(0.1f), matte("panel", 0, 40), above);
  const Baked baked(scene, {}, {.bounces = 0, .error = 0.005});
  const std::vector<glm::dvec3> panel = {{0.1, 0.7, -0.1}, {0.3, 0.7, -0.1}, {0.3, 0.7, 0.1}, {0.1, 0.7, 0.1}};
  int count = 0;
  baked.forWhole([&](const SurfacePoint& point, const TexelLight&, const TexelLight& gathered) {
    if (point.instance != 0) return;
    const double E = 40 * lambert(panel, point.position, {0, 1, 0});
    EXPECT_NEAR(gathered.irradiance.x, E, 0.01 * E);
    ++count;
  });
  EXPECT_GE(count, 500);
}

// What stands on a floor hides it, and what lies in it is not baked.
TEST(Integrate, TexelsWithinOtherObjectsAreNotValid) {
  scenes::Scene scene;
  addObject(scene, square(1), matte("floor", 0.5f));
  addObject(scene, scenes::makeRoundedBox({0.4, 0.3, 0.4}, 0.02, 1), matte("box", 0.5f),
            glm::translate(glm::mat4(1.f), glm::vec3(0, 0.2f, 0))); // sunk by 10 cm
  const Baked baked(scene, {{}, {}, evenSky(glm::vec3(1))}, {.error = 0.1, .maxSamples = 512}, 16);
  int within = 0, outside = 0;
  for (std::size_t i = 0; i < baked.grid.texels().size(); ++i) {
    const Texel& texel = baked.grid.texels()[i];
    if (texel.instance != 0) continue;
    for (int s = 0; s < 16; ++s) {
      const auto point = baked.grid.at(texel.page, 4 * texel.x + s % 4, 4 * texel.y + s / 4);
      if (!point) continue;
      const float reach = std::max(std::abs(point->position.x), std::abs(point->position.z));
      const bool isValid = (baked.light.valid[i] & 1 << s) != 0;
      if (reach < 0.39f) {
        EXPECT_FALSE(isValid) << point->position.x << ' ' << point->position.z;
        ++within;
      } else if (reach > 0.41f) {
        EXPECT_TRUE(isValid) << point->position.x << ' ' << point->position.z;
        ++outside;
      }
    }
  }
  EXPECT_GE(within, 1500);
  EXPECT_GE(outside, 10000);
}

TEST(Integrate, LightInAWallLightsNothing) {
  scenes::Scene scene;
  addObject(scene, insideOfBox(2), matte("room", 0.5f));
  addObject(scene, scenes::makeRoundedBox({0.3, 1.2, 1.2}, 0.02, 1), matte("wall", 0.5f));
  const Baked baked(scene, {{pointLight({0.1f, 0.2f, 0.1f}, glm::vec3(100))}, {}, {}}, {.maxSamples = 512}, 4);
  baked.forWhole([&](const SurfacePoint&, const TexelLight& direct, const TexelLight& gathered) {
    EXPECT_EQ(direct.irradiance, glm::vec3(0));
    EXPECT_EQ(gathered.irradiance, glm::vec3(0));
  });
}

// A room that the sun shines into: reflected once, its light is what the lit patch sends out.
TEST(Integrate, SunIsNotInTheLightmapButItsBouncesAre) {
  scenes::Scene scene;
  addObject(scene, square(1), matte("floor", 0.5f));
  scenes::Mesh wall = square(1);
  addObject(scene, wall, matte("wall", 0.5f),
            glm::rotate(glm::translate(glm::mat4(1.f), glm::vec3(-1, 1, 0)), glm::radians(-90.f), glm::vec3(0, 0, 1)));
  scenes::Light sun;
  sun.kind = scenes::LightKind::directional;
  sun.direction = glm::vec3(0, -1, 0);
  sun.color = glm::vec3(3);
  const Baked baked(scene, {{sun}, 0, {}}, {.bounces = 1, .error = 0.003, .maxSamples = 1 << 16});
  const std::vector<glm::dvec3> floor = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  int walls = 0;
  baked.forWhole([&](const SurfacePoint& point, const TexelLight& direct, const TexelLight& gathered) {
    EXPECT_EQ(direct.irradiance, glm::vec3(0));
    const double E = point.instance == 1 ? 0.5 * 3 / pi * lambert(floor, point.position, {1, 0, 0}) : 0;
    EXPECT_NEAR(gathered.irradiance.x, E, 0.01 * E);
    walls += point.instance == 1;
  });
  EXPECT_GE(walls, 200);
  for (std::size_t i = 0; i < baked.light.sunLit.size(); ++i)
    if (baked.grid.texels()[i].instance == 0 && baked.light.valid[i] == 0xffff) {
      EXPECT_EQ(baked.light.sunLit[i], 0xffff);
    }
}

// A ball under a roof that leaves none of it to the sun: light along its terminator would be a leak.
TEST(Integrate, SunLightsNothingThatIsWhollyInShadow) {
  scenes::Scene scene;
  addObject(scene, scenes::makeSphere(0.5, 32, 16), matte("ball", 0.5f));
  addObject(scene, square(5), matte("roof", 0.5f), glm::translate(glm::mat4(1.f), glm::vec3(0, 2, 0)));
  scenes::Light sun;
  sun.kind = scenes::LightKind::directional;
  sun.direction = glm::vec3(-0.6f, -0.8f, 0);
  const Baked baked(scene, {{sun}, 0, {}}, {.bounces = 0}, 16);
  int lit = 0, shadowed = 0;
  for (const SunMask& mask : makeSunMasks(baked.atlas, baked.grid, baked.light))
    for (int y = 0; y < mask.sight.height; ++y)
      for (int x = 0; x < mask.sight.width; ++x) {
        if (mask.ownerAt(x, y) != 0) continue;
        lit += *mask.sight.at(x, y) == kLit;
        shadowed += *mask.sight.at(x, y) == kShadowed;
      }
  EXPECT_EQ(lit, 0);
  EXPECT_GT(shadowed, 1000);
}

// ---- the work: threads, cache, cancelling

struct Work {
  scenes::Scene scene;
  BakeLights lights;
  Work() {
    addObject(scene, square(1), matte("floor", 0.5f));
    addObject(scene, scenes::makeSphere(0.3, 24, 12), matte("ball", 0.7f, 0.1f),
              glm::translate(glm::mat4(1.f), glm::vec3(0, 0.4f, 0)));
    lights = {{pointLight({1, 1, 0}, glm::vec3(2))}, {}, evenSky(glm::vec3(0.3f))};
  }
};

bool areSame(const StaticLight& a, const StaticLight& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::ranges::equal(std::as_bytes(std::span(x)), std::as_bytes(std::span(y)));
  };
  return same(a.direct, b.direct) && same(a.gathered, b.gathered) && same(a.valid, b.valid) &&
         same(a.sunLit, b.sunLit) && same(a.facesSun, b.facesSun) && same(a.error, b.error) &&
         same(a.samples, b.samples);
}

TEST(Integrate, IsTheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  const Work work;
  const IntegrateOptions options{.error = 0.05};
  const StaticLight all = Baked(work.scene, work.lights, options).light;
  {
    const base::ThreadLimit one(1);
    EXPECT_TRUE(areSame(all, Baked(work.scene, work.lights, options).light));
  }
  EXPECT_FALSE(areSame(all, Baked(work.scene, work.lights, {.error = 0.05, .seed = 1}).light));
}

TEST(Integrate, GoesOnFromItsCacheWhenItWasCancelled) {
  const Work work;
  const parity::base::TempFolder folder;
  const base::Cache cache(folder.path());
  const StaticLight whole = Baked(work.scene, work.lights).light;
  std::atomic<int> asked = 0;
  Control control{.cache = &cache, .key = "key"};
  control.isCancelled = [&] { return ++asked > 3000; };
  base::expectError([&] { Baked(work.scene, work.lights, {}, 16, control); }, {"cancelled"});
  EXPECT_GT(cache.describe().entries, 0u);
  control.isCancelled = {};
  const StaticLight again = Baked(work.scene, work.lights, {}, 16, control).light;
  EXPECT_TRUE(areSame(again, Baked(work.scene, work.lights, {}, 16).light));
  const StaticLight cached = Baked(work.scene, work.lights, {}, 16, control).light;
  EXPECT_TRUE(areSame(again, cached));
  EXPECT_EQ(cached.rays, 0u);
  control.key = "another scene";
  EXPECT_GT(Baked(work.scene, work.lights, {}, 16, control).light.rays, 0u);
}

TEST(Integrate, SamplesUntilTheErrorIsWhatWasWanted) {
  const Work work;
  std::vector<double> samples;
  for (const double wanted : {0.05, 0.005, 0.002}) {
    const StaticLight light = Baked(work.scene, work.lights, {.error = wanted, .maxSamples = 1 << 16}).light;
    double sum = 0;
    for (std::size_t i = 0; i < light.error.size(); ++i) {
      EXPECT_LE(light.error[i], wanted) << light.samples[i];
      sum += light.samples[i];
    }
    samples.push_back(sum);
  }
  EXPECT_LT(samples[0], samples[1]);
  EXPECT_LT(samples[1], samples[2]);
}

TEST(Integrate, NoLightAtAllIsBlack) {
  Work work;
  work.scene.materials[1].emissive = glm::vec3(0);
  const StaticLight light = Baked(work.scene, {}).light;
  for (std::size_t i = 0; i < light.gathered.size(); ++i) {
    EXPECT_EQ(light.gathered[i].irradiance, glm::vec3(0));
    EXPECT_EQ(light.direct[i].irradiance, glm::vec3(0));
    EXPECT_EQ(light.error[i], 0);
  }
}

} // namespace
} // namespace parity::bake
