// The numbers of `parity plot env-brdf` against quadrature of the textbook model and the article's constants.
#include "study/plot/env_brdf.h"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "study/plot/env_brdf_plot.h"

namespace parity::plot {
namespace {

constexpr double kRoughness[] = {0.1, 0.3, 0.5, 0.8, 1}, kCosines[] = {0.08, 0.3, 0.6, 1};

TEST(TableBrdf, isTheIntegralOfEitherGeometryTerm) {
  for (const highend::GeometryTerm term :
       {highend::GeometryTerm::heightCorrelated, highend::GeometryTerm::schlickSmith}) {
    const TableBrdf table({.model = {.geometryTerm = term}});
    for (const double roughness : kRoughness)
      for (const double NoV : kCosines) {
        const tests::EnvBrdf truth =
            tests::integrateEnvBrdf(term == highend::GeometryTerm::schlickSmith ? tests::Geometry::schlickSmith
                                                                                : tests::Geometry::heightCorrelated,
                                    roughness, NoV);
        const EnvBrdf read = table.at(roughness, NoV);
        EXPECT_NEAR(read.A, truth.A, 2e-3) << roughness << " " << NoV; // bilinear between texels
        EXPECT_NEAR(read.B, truth.B, 2e-3);
        EXPECT_NEAR(table.once(roughness, NoV, {0.04, 0.5, 1}).y, 0.5 * read.A + read.B, 1e-12);
        EXPECT_NEAR(table.once(roughness, NoV, {0.04, 0.5, 1}, 0.5).z, read.A + 0.5 * read.B, 1e-12);
      }
  }
}

// The article's function, its constants written out here.
double articleAt(double R, double N, double F0) {
  const double rx = 1 - R, ry = 0.0425 - 0.0275 * R, rz = 1.04 - 0.572 * R, rw = 0.022 * R - 0.04;
  const double a004 = std::min(rx * rx, std::exp2(-9.28 * N)) * rx + ry;
  return F0 * (rz - 1.04 * a004) + 1.04 * a004 + rw;
}

TEST(ApproximateBrdf, isThePresetsOwn) {
  const ApproximateBrdf karis(mobile::presetByName("karis2014")), ue4(mobile::presetByName("ue4-2020"));
  for (const double roughness : kRoughness)
    for (const double NoV : kCosines) {
      for (const double F0 : {0.04, 1.0})
        for (const ApproximateBrdf* brdf : {&karis, &ue4})
          EXPECT_NEAR(brdf->once(roughness, NoV, glm::dvec3(F0)).x, articleAt(roughness, NoV, F0), 1e-6);
      EXPECT_NEAR(karis.at(roughness, NoV).A + karis.at(roughness, NoV).B, 1 - 0.55 * roughness, 1e-6);
      EXPECT_EQ(karis.multiple(roughness, NoV, glm::dvec3(1)).x, 0);
    }
  EXPECT_EQ(ue4.once(0.4, 0.5, glm::dvec3(0)).y, 0) << "B is off where F0 is 0";
  EXPECT_GT(karis.once(0.4, 0.5, glm::dvec3(0)).y, 0.01);
  // The preset's roughness floor.
  EXPECT_EQ(ue4.at(0, 0.3).A, ue4.at(0.015625, 0.3).A);
  EXPECT_NE(karis.at(0, 0.3).A, karis.at(0.015625, 0.3).A);
}

TEST(ApproximateBrdf, ofAMaterialTakesTheFormThatThePathTakes) {
  const ApproximateBrdf ue4(mobile::presetByName("ue4-2020"));
  shading::f64::MobileMaterial m;
  m.BaseColor = {0.5, 0.25, 1};
  m.Metallic = 0;
  m.DielectricSpecular = {0.04, 0.04, 0.04};
  m.F90 = 1;
  m.Roughness = 0.5;
  EXPECT_NEAR(ue4.once(m, false, false, 0.4).x, articleAt(0.5, 0.4, 0.04), 1e-6);
  const double a004 = std::min(0.25, std::exp2(-9.28 * 0.4)) * 0.5 + 0.0425 - 0.0275 * 0.5;
  EXPECT_NEAR(ue4.once(m, true, false, 0.4).x, a004, 1e-6) << "EnvBRDFApproxNonmetal";
  EXPECT_NEAR(ue4.once(m, false, true, 0.4).x, 0.45 * 0.04, 1e-12) << "fully rough";
}

// SHADING 2: over the core, max and rms of EnvBRDFApprox against either truth.
TEST(Deviation, isWhatIsPublished) {
  const ApproximateBrdf karis(mobile::presetByName("karis2014"));
  struct Published {
    highend::GeometryTerm term;
    double F0, max, rms;
  };
  for (const Published& p : {Published{highend::GeometryTerm::schlickSmith, 0.04, .161, .024},
                             {highend::GeometryTerm::schlickSmith, 1, .238, .076},
                             {highend::GeometryTerm::heightCorrelated, 0.04, .084, .020},
                             {highend::GeometryTerm::heightCorrelated, 1, .396, .127}}) {
    const Deviation d = deviationOf(TableBrdf({.model = {.geometryTerm = p.term}}), karis, p.F0);
    EXPECT_NEAR(d.max, p.max, 0.01); // of the middles of cells: the corner itself is in none
    EXPECT_NEAR(d.rms, p.rms, 0.001);
  }
}

// In a white furnace what is missing once comes back: at F0 = 1 both add up to 1, with Kulla and Conty's on the mean.
TEST(TableBrdf, multipleScatteringIsApartAndWhatIsMissing) {
  for (const highend::Compensation compensation : {highend::Compensation::turquin, highend::Compensation::fdezAguera}) {
    const TableBrdf table({.compensation = compensation});
    for (const double roughness : kRoughness)
      EXPECT_NEAR(table.once(roughness, 0.6, glm::dvec3(1)).x + table.multiple(roughness, 0.6, glm::dvec3(1)).x, 1,
                  1e-9);
  }
  const TableBrdf none({.compensation = highend::Compensation::none}), kulla({});
  EXPECT_EQ(none.multiple(0.8, 0.5, glm::dvec3(1)).x, 0);
  EXPECT_EQ(none.once(0.8, 0.5, glm::dvec3(1)).x, kulla.once(0.8, 0.5, glm::dvec3(1)).x);
  EXPECT_NEAR(kulla.once(0.8, 0.5, glm::dvec3(1)).x + kulla.multiple(0.8, 0.5, glm::dvec3(1)).x, 1, 1e-9);
  EXPECT_LT(kulla.multiple(0.8, 0.5, glm::dvec3(0.04)).x, 0.01 * kulla.multiple(0.8, 0.5, glm::dvec3(1)).x);
  const ApproximateBrdf refit(mobile::presetByName("refit"));
  EXPECT_NEAR(refit.once(0.8, 0.5, glm::dvec3(1)).x + refit.multiple(0.8, 0.5, glm::dvec3(1)).x, 1, 1e-9);
}

TEST(EnvBrdfCsv, hasALineForEachPlaceThatAddsUp) {
  const TableBrdf table({});
  const ApproximateBrdf karis(mobile::presetByName("karis2014"));
  std::istringstream text(envBrdfCsv(table, karis));
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

} // namespace
} // namespace parity::plot
