// The prefiltered cube on real panoramas, against a brute-force sum over every texel of the base cube.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "base/parallel.h"
#include "lighting/cube.h"
#include "lighting/environment_light.h"
#include "scenes/load.h"
#include "shading/shading.h"

namespace parity::lighting {
namespace {

namespace f64 = shading::f64;

double lobe(double alpha, double NoL) { return NoL > 0 ? f64::D_GGX(alpha, std::sqrt((1 + NoL) / 2)) * NoL : 0; }

// The lobe around N = V averaged over 4 x 4 points of texel i of the base cube, which is not small against its peak.
double meanLobe(double alpha, const glm::dvec3& N, std::size_t i) {
  const int face = static_cast<int>(i / (256 * 256)), x = static_cast<int>(i % 256),
            y = static_cast<int>(i / 256 % 256);
  double sum = 0;
  for (int k = 0; k < 16; ++k) {
    const double s = (2 * x + 0.25 + 0.5 * (k % 4)) / 256 - 1, t = (2 * y + 0.25 + 0.5 * (k / 4)) / 256 - 1;
    sum += lobe(alpha, glm::dot(N, glm::normalize(directionOf({face, s, t}))));
  }
  return sum / 16;
}

struct Map {
  const char* file;
  double narrowBound; // on the median error of mips 1 and 2
};

class RealMap : public testing::TestWithParam<Map> {};

TEST_P(RealMap, mipsAreWithinAFewPercentOfTheFullSum) {
  const char* shared = std::getenv("PARITY_SHARED");
  const std::filesystem::path file =
      std::filesystem::path(PARITY_SOURCE_DIR) / (shared ? shared : "../shared") / "assets/env" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << GetParam().file;
  std::vector<std::string> warnings;
  const EnvironmentLight light = makeEnvironmentLight(scenes::loadEnvironment(file.string(), 0, warnings), {});
  const std::vector<glm::vec4>& base = light.prefiltered.mips[0];
  const std::vector<double> solidAngles = texelSolidAngles(256);
  std::vector<glm::dvec3> directions;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < 256 * 256; ++i) directions.push_back(texelDirection(face, i % 256, i / 256, 256));

  std::mt19937 random(1);
  for (int mip = 1; mip <= f64::kPrefilterRoughestMip; ++mip) {
    const double alpha = std::pow(f64::roughnessFromMip(mip), 2);
    constexpr int kPoints = 100;
    std::vector<double> errors(kPoints);
    std::vector<std::size_t> picks(kPoints);
    for (std::size_t& pick : picks) pick = random() % light.prefiltered.mips[mip].size();
    base::parallelFor(kPoints, 1, [&](std::size_t k, std::size_t) {
      const int n = 256 >> mip, index = static_cast<int>(picks[k]);
      const glm::dvec3 N = texelDirection(index / (n * n), index % n, index / n % n, n);
      glm::dvec3 sum(0);
      double weights = 0;
      for (std::size_t i = 0; i < base.size(); ++i) {
        const double NoL = glm::dot(N, directions[i]);
        if (NoL <= 0) continue;
        const double weight =
            (NoL > 0.97 ? meanLobe(alpha, N, i) : lobe(alpha, NoL)) * solidAngles[i % solidAngles.size()];
        sum += weight * glm::dvec3(glm::vec3(base[i]));
        weights += weight;
      }
      const glm::dvec3 expected = sum / weights;
      errors[k] =
          glm::length(glm::dvec3(glm::vec3(light.prefiltered.mips[mip][picks[k]])) - expected) / glm::length(expected);
    });
    std::sort(errors.begin(), errors.end());
    RecordProperty("mip" + std::to_string(mip) + "_median", std::to_string(errors[kPoints / 2]));
    std::printf("%s roughness %.2f: median %.2f %%, p95 %.2f %%\n", GetParam().file, f64::roughnessFromMip(mip),
                100 * errors[kPoints / 2], 100 * errors[kPoints * 95 / 100]);
    // SHADING 6 gives 2.1 to 3.4 % at 256 samples. Measured: 2 to 3 % for mips 1 and 2 (studio 5 to 10 %: texels a
    // hundred times darker than the softboxes beside them feel the footprints' blur), 0.1 to 3.4 % for the rest.
    // Against the neighbouring mip's roughness it would be 12 to 33 % (studio 43 and 55 %) and 31 to 59 %.
    EXPECT_LE(errors[kPoints / 2], mip <= 2 ? GetParam().narrowBound : 0.06) << "mip " << mip;
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, RealMap,
                         testing::Values(Map{"studio_small_05_1k.hdr", 0.2}, Map{"chinese_garden_1k.hdr", 0.06},
                                         Map{"st_peters_square_night_1k.hdr", 0.06}),
                         [](const auto& which) {
                           const std::string file = which.param.file;
                           return file.substr(0, file.find('_'));
                         });

} // namespace
} // namespace parity::lighting
