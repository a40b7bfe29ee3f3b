// The prefiltered environment as it is read, against a sum over every cell of the panorama: the promised error, map by
// map, with the suns taken out.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "lighting/environment/sun_extraction.h"
#include "scenes/load.h"
#include "support/prefilter_truth.h"
#include "support/shared_assets.h"

namespace parity::lighting {
namespace {

const std::vector<double> kRoughnesses = {0.03, 0.06, 0.09, 0.12, 0.16, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
constexpr std::size_t kSmooth = 5; // of these are below 0.2

struct Map {
  const char* name;                            // builtin:NAME, or a file
  double smoothBound, medianBound, worstBound; // medians below .2 and from there on, worst from there on
  bool extracted;
};
void PrintTo(const Map& map, std::ostream* out) { *out << map.name << (map.extracted ? "" : ", sun left in"); }

class PrefilterError : public testing::TestWithParam<Map> {};

// Measured: docs/environments.md. As mobile reads the medians are 4 (garden), 7 (night) and 21 % (studio).
TEST_P(PrefilterError, IsWithinWhatIsPromised) {
  std::string file = GetParam().name;
  if (!file.starts_with("builtin:")) {
    file = tests::sharedEnvironment(file).string();
    if (file.empty()) GTEST_SKIP() << "no " << GetParam().name;
  }
  std::vector<std::string> warnings;
  scenes::Environment environment = scenes::loadEnvironment(file, 0, warnings);
  if (GetParam().extracted) environment = extractSuns(std::move(environment)).environment;
  const std::vector<glm::dvec3> directions = tests::makeDirections(40);
  const auto truth = tests::integrateLobes(environment, directions, kRoughnesses);
  const PanoramaCells cells = makePanoramaCells(environment);
  const tests::PrefilterReader reader(makeEnvironmentLight(environment, kFinePrefilter), &cells);
  std::vector<double> errors =
      tests::relativeRmse(truth, directions, kRoughnesses, std::bind_front(&tests::PrefilterReader::read, &reader));
  const auto rough = errors.begin() + kSmooth;
  std::sort(errors.begin(), rough);
  std::sort(rough, errors.end());
  const double smoothMedian = errors[kSmooth / 2], median = errors[(kSmooth + errors.size()) / 2];
  RecordProperty("smooth median", std::to_string(smoothMedian));
  RecordProperty("median", std::to_string(median));
  EXPECT_LE(smoothMedian, GetParam().smoothBound);
  EXPECT_LE(median, GetParam().medianBound);
  EXPECT_LE(errors.back(), GetParam().worstBound);
}

INSTANTIATE_TEST_SUITE_P(Builtin, PrefilterError,
                         testing::Values(Map{"builtin:sky", 0.005, 0.003, 0.006, true},
                                         Map{"builtin:studio", 0.015, 0.006, 0.012, true},
                                         Map{"builtin:sky", 0.03, 0.02, 0.05, false}));
INSTANTIATE_TEST_SUITE_P(Shared, PrefilterError,
                         testing::Values(Map{"chinese_garden_1k.hdr", 0.03, 0.01, 0.02, true},
                                         Map{"st_peters_square_night_1k.hdr", 0.1, 0.015, 0.08, true},
                                         Map{"studio_small_05_1k.hdr", 0.11, 0.035, 0.065, true}));

} // namespace
} // namespace parity::lighting
