// The high-end path's environment BRDF in double against quadrature of the textbook model.
#include "highend/table_brdf.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shading/quadrature.h"

namespace parity::highend {
namespace {

constexpr double kRoughness[] = {0.1, 0.3, 0.5, 0.8, 1}, kCosines[] = {0.08, 0.3, 0.6, 1};

TEST(TableBrdf, IsTheIntegralOfEitherGeometryTerm) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
    const TableBrdf table({.model = {.geometryTerm = term}});
    for (const double roughness : kRoughness)
      for (const double NoV : kCosines) {
        const tests::EnvBrdf truth = tests::integrateEnvBrdf(
            term == GeometryTerm::schlickSmith ? tests::Geometry::schlickSmith : tests::Geometry::heightCorrelated,
            roughness, NoV);
        const paths::EnvBrdf::AB read = table.at(roughness, NoV);
        EXPECT_NEAR(read.A, truth.A, 2e-3) << roughness << " " << NoV; // bilinear between texels
        EXPECT_NEAR(read.B, truth.B, 2e-3);
        EXPECT_NEAR(table.once(roughness, NoV, {0.04, 0.5, 1}).y, 0.5 * read.A + read.B, 1e-12);
        const paths::EnvBrdfMaterial halfF90{
            .metallic = 0, .roughness = roughness, .dielectric = glm::dvec3(1), .dielectricF90 = 0.5};
        EXPECT_NEAR(table.once(halfF90, NoV).z, read.A + 0.5 * read.B, 1e-12);
      }
  }
}

// In a white furnace what is missing once comes back: at F0 = 1 both add up to 1, with Kulla and Conty's on the mean.
TEST(TableBrdf, MultipleScatteringIsApartAndWhatIsMissing) {
  for (const Compensation compensation : {Compensation::turquin, Compensation::fdezAguera}) {
    const TableBrdf table({.compensation = compensation});
    for (const double roughness : kRoughness)
      EXPECT_NEAR(table.once(roughness, 0.6, glm::dvec3(1)).x + table.multiple(roughness, 0.6, glm::dvec3(1)).x, 1,
                  1e-9);
  }
  const TableBrdf none({.compensation = Compensation::none}), kulla({});
  EXPECT_EQ(none.multiple(0.8, 0.5, glm::dvec3(1)).x, 0);
  EXPECT_EQ(none.once(0.8, 0.5, glm::dvec3(1)).x, kulla.once(0.8, 0.5, glm::dvec3(1)).x);
  EXPECT_NEAR(kulla.once(0.8, 0.5, glm::dvec3(1)).x + kulla.multiple(0.8, 0.5, glm::dvec3(1)).x, 1, 1e-9);
  EXPECT_LT(kulla.multiple(0.8, 0.5, glm::dvec3(0.04)).x, 0.01 * kulla.multiple(0.8, 0.5, glm::dvec3(1)).x);
}

} // namespace
} // namespace parity::highend
