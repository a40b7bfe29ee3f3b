// The numbers of `parity plot env-brdf`: published errors, and a CSV whose columns add up.
#include "study/plot/env_brdf.h"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "default_pair.h"
#include "study/plot/env_brdf_plot.h"

namespace parity::plot {
namespace {

// docs/shading.md 2b: over the core, max and rms of EnvBRDFApprox against either truth.
TEST(Deviation, IsWhatIsPublished) {
  struct Published {
    highend::GeometryTerm term;
    double F0, max, rms;
  };
  for (const Published& p : {Published{highend::GeometryTerm::schlickSmith, 0.04, .161, .024},
                             {highend::GeometryTerm::schlickSmith, 1, .238, .076},
                             {highend::GeometryTerm::heightCorrelated, 0.04, .084, .020},
                             {highend::GeometryTerm::heightCorrelated, 1, .396, .127}}) {
    const Deviation d = deviationOf(pairWith("karis2014", {.model = {.geometryTerm = p.term}}), p.F0);
    EXPECT_NEAR(d.max, p.max, 0.01); // of the middles of cells: the corner itself is in none
    EXPECT_NEAR(d.rms, p.rms, 0.001);
  }
}

TEST(EnvBrdfCsv, HasALineForEachPlaceThatAddsUp) {
  std::istringstream text(envBrdfCsv(pairWith("karis2014")));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line.substr(0, 55), "roughness,NoV,table_A,mobile_A,difference_A,table_B,mob");
  int count = 0;
  for (; std::getline(text, line); ++count) {
    std::vector<double> numbers;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    ASSERT_EQ(numbers.size(), 20u) << line;
    for (std::size_t k = 2; k < 20; k += 3) EXPECT_NEAR(numbers[k + 2], numbers[k + 1] - numbers[k], 1e-6) << line;
    // F0 A + B of the line's own A and B.
    EXPECT_NEAR(numbers[8], 0.04 * numbers[2] + numbers[5], 1e-6) << line;
    EXPECT_NEAR(numbers[15], numbers[3] + numbers[6], 1e-6) << line;
    EXPECT_NEAR(numbers[0], count / 65 / 64.0, 1e-9);
    EXPECT_NEAR(numbers[1], count % 65 / 64.0, 1e-9);
  }
  EXPECT_EQ(count, 65 * 65);
}

// The order of the paths is who is held against whom.
TEST(PlottedPair, IsAsTheyAreNamed) {
  const PlottedPair pair = pairWith("ue4-2020"), turned = pairOf({&mobile::path(), &highend::path()}, {});
  EXPECT_EQ(turned.reference.title, "mobile");
  EXPECT_EQ(turned.test.words.label, "table");
  EXPECT_EQ(deviationOf(turned, 1).max, deviationOf(pair, 1).max);
  EXPECT_EQ(envBrdfCsv(turned).substr(0, 49), "roughness,NoV,mobile_A,table_A,difference_A,mobil");
  EXPECT_THROW(pairOf({&mobile::path()}, {}), base::Error);
}

} // namespace
} // namespace parity::plot
