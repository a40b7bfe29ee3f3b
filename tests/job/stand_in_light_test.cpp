// A stand-in for an environment is of the kind of the real one: a software driver compiles no other shader for it.
#include <gtest/gtest.h>

#include <bit>

#include "job/paths.h"
#include "job/scene/stand_in_light.h"
#include "lighting/environment/environment_light.h"

namespace parity::job {
namespace {

// A white panorama; lamp: one of its pixels is brighter.
scenes::Environment makePanorama(int width, int height, bool lamp) {
  scenes::Environment environment;
  environment.radiance = base::Image(width, height, 3);
  for (float& value : environment.radiance.pixels) value = 1;
  if (lamp) environment.radiance.pixels[3 * (width * height / 2)] = 100;
  return environment;
}

bool isPowerOfTwo(int side) { return std::has_single_bit(static_cast<unsigned>(side)); }

TEST(StandInLight, IsOfTheKindOfTheEnvironmentToCome) {
  for (const paths::Path* path : allPaths())
    for (const bool lamp : {false, true})
      for (const int width : {1024, 1100}) {
        SCOPED_TRACE(path->name() + (lamp ? ", a lamp, " : ", no lamp, ") + std::to_string(width));
        paths::LightNeeds needs = path->lightNeeds(Settings{}.options);
        needs.prefilter.faceSize = 64, needs.prefilter.sampleCount = 1;
        const scenes::Environment panorama = makePanorama(width, 512, lamp);
        paths::Light real;
        if (needs.cells)
          real.cells = std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(panorama));
        const paths::Light standIn = standInLight(real, needs);
        const lighting::EnvironmentLight environment = lighting::makeEnvironmentLight(panorama, needs.prefilter);
        const lighting::CubeMap &wanted = environment.prefiltered, &cube = standIn.environment->prefiltered;
        ASSERT_EQ(cube.mips.size(), wanted.mips.size());
        for (int mip = 0; mip < static_cast<int>(cube.mips.size()); ++mip)
          EXPECT_EQ(lighting::layersOf(cube, mip), lighting::layersOf(wanted, mip)) << mip;
        EXPECT_EQ(standIn.environment->irradianceCube.size(), environment.irradianceCube.size());
        const auto hasLamps = [](const lighting::EnvironmentLight& light) {
          return !light.lamps.wide.nodes.empty() || !light.lamps.compact.nodes.empty();
        };
        EXPECT_EQ(hasLamps(*standIn.environment), hasLamps(environment));
        ASSERT_EQ(standIn.cells != nullptr, real.cells != nullptr);
        if (!real.cells) continue;
        EXPECT_EQ(isPowerOfTwo(standIn.cells->width), isPowerOfTwo(real.cells->width));
        EXPECT_EQ(isPowerOfTwo(standIn.cells->height), isPowerOfTwo(real.cells->height));
        EXPECT_EQ(standIn.cells->mips.size() > 1, real.cells->mips.size() > 1);
      }
}

} // namespace
} // namespace parity::job
