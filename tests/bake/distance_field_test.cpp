// Distance-field shadows against shapes of known distance, area and blur, and on the courtyard.
#include "bake/encode/distance_field.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "bake/sun_masks.h"
#include "base/error.h"
#include "base/parallel.h"
#include "lighting/surface/visibility.h"
#include "scenes/builtin/builtin.h"

namespace parity::bake {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;

// Figures of issue 10: in the band, outside, and of the shadow's area.
void expectGood(const SunMask& mask, const DistanceFieldOptions& options, const std::string& what,
                double inBand = 0.1) {
  const DistanceFieldError error = measureDistanceField(mask, makeDistanceField(mask, options), options);
  EXPECT_LE(error.inBand, inBand) << what;
  EXPECT_LE(error.outside, 0.005) << what;
  EXPECT_NEAR(error.shadowArea, 1, 0.1) << what;
  EXPECT_GT(error.bandShare, 0) << what;
}

// The decoded integral over a transition: encodeDistance's shift makes it that of a step.
TEST(DistanceField, ShiftKeepsTheAreaThatTheSquareTakes) {
  for (const double penumbra : {0.5, 1.0, 3.0}) {
    const DistanceFieldOptions options{.range = 4, .penumbra = penumbra};
    double light = 0;
    constexpr double kStep = 1e-4;
    for (double s = -4 + 0.5 * kStep; s < 4; s += kStep)
      light += kStep * decodeVisibility(encodeDistance(s, options), transitionScaleOf(options));
    EXPECT_NEAR(light, 4, 1e-3) << penumbra;
  }
}

TEST(DistanceField, IsTheSignedDistanceToAStraightEdge) {
  const DistanceFieldOptions options{.range = 4, .penumbra = 1, .sweeps = 0};
  for (const int factor : {1, 2, 3, 4, 8}) {
    const SunMask mask = makeSunMask(24, factor, [](double x, double) { return x < 0; }); // between texels 11 and 12
    const DistanceField field = makeDistanceField(mask, options);
    EXPECT_EQ(field.transitionScale, 8);
    for (int x = 2; x < 22; ++x) {
      const double d = std::clamp(encodeDistance(x + 0.5 - 12, options), 0.0, 1.0);
      EXPECT_NEAR(*field.codes.at(x, 12), 255 * d, 0.51) << factor << " " << x;
    }
  }
}

TEST(DistanceField, IsTheSignedDistanceToADisk) {
  const DistanceFieldOptions options{.range = 4, .penumbra = 1, .sweeps = 0};
  const SunMask mask = makeSunMask(40, 8, [](double x, double y) { return x * x + y * y < 81; });
  const DistanceField field = makeDistanceField(mask, options);
  for (int y = 2; y < 38; ++y)
    for (int x = 2; x < 38; ++x) {
      const double distance = std::hypot(x + 0.5 - 20, y + 0.5 - 20) - 9;
      if (std::abs(distance) < 3) { // sub-texels are 1/8 wide
        EXPECT_NEAR(*field.codes.at(x, y) / 255.0 * 8 - 4 - 1.0 / 6, distance, 0.15) << x << " " << y;
      }
    }
}

TEST(DistanceField, KeepsShapesOfAllWidthsAnglesAndPhases) {
  for (const int factor : {3, 4})
    for (const double degrees : {0.0, 13.0, 30.0, 45.0, 77.0})
      for (const double phase : {0.0, 0.25, 0.5}) {
        const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
        const auto across = [=](double x, double y) { return c * x + s * y - phase; };
        const std::string name = std::to_string(degrees) + " degrees, phase " + std::to_string(phase);
        expectGood(makeSunMask(36, factor, [&](double x, double y) { return across(x, y) < 0; }), {}, "edge " + name);
        for (const double width : {1.0, 2.0, 3.0, 4.0}) {
          const auto strip = [&](double x, double y) { return std::abs(across(x, y)) < 0.5 * width; };
          // Halfway between two rows of texels, a strip as wide as one is flat where its blur has a ridge.
          expectGood(makeSunMask(36, factor, strip), {}, "strip " + std::to_string(width) + ", " + name,
                     width == 1 ? 0.17 : 0.1);
        }
      }
  for (const double radius : {1.0, 2.5, 9.0})
    expectGood(makeSunMask(36, 4, [&](double x, double y) { return std::hypot(x - 0.3, y) < radius; }), {}, "disk");
}

// What the fit is for.
TEST(DistanceField, FitKeepsAThinStripThatDistancesAloneLose) {
  const SunMask mask = makeSunMask(36, 4, [](double x, double) { return std::abs(x) < 0.25; }); // half a texel wide
  const DistanceFieldOptions plain{.sweeps = 0}, fitted;
  const DistanceFieldError without = measureDistanceField(mask, makeDistanceField(mask, plain), plain);
  const DistanceFieldError with = measureDistanceField(mask, makeDistanceField(mask, fitted), fitted);
  EXPECT_LT(without.shadowArea, 0.5);
  EXPECT_NEAR(with.shadowArea, 1, 0.05);
  EXPECT_LT(with.inBand, 0.3 * without.inBand);
}

TEST(DistanceField, PenumbraIsAsWideAsAskedFor) {
  const SunMask mask = makeSunMask(48, 4, [](double x, double) { return x < 0.3; });
  for (const double penumbra : {1.0, 2.0, 4.0}) {
    const DistanceFieldOptions options{.range = 6, .penumbra = penumbra};
    const DistanceField field = makeDistanceField(mask, options);
    double dark = 0, bright = 0; // where visibility along a row passes 1/4 and 3/4
    for (double x = 12; x < 36; x += 0.01) {
      const int lower = static_cast<int>(x - 0.5);
      const double d =
          std::lerp(*field.codes.at(lower, 20) / 255.0, *field.codes.at(lower + 1, 20) / 255.0, x - 0.5 - lower);
      const double visibility = decodeVisibility(d, field.transitionScale);
      if (visibility < 0.25) dark = x;
      if (visibility < 0.75) bright = x;
    }
    EXPECT_NEAR(bright - dark, 0.5 * penumbra, 0.2) << penumbra;
  }
}

TEST(DistanceField, IsAtItsEndsWhereAChartIsWhollyLitOrShadowed) {
  for (const bool isShadowed : {false, true}) {
    const SunMask mask = makeSunMask(12, 4, [&](double, double) { return isShadowed; });
    const DistanceField field = makeDistanceField(mask, {});
    for (int y = 1; y < 11; ++y)
      for (int x = 1; x < 11; ++x) EXPECT_EQ(*field.codes.at(x, y), isShadowed ? 0 : 255) << x << " " << y;
    const DistanceFieldError error = measureDistanceField(mask, field, {});
    EXPECT_EQ(error.outside, 0);
    EXPECT_EQ(error.bandShare, 0);
    EXPECT_EQ(error.shadowArea, 1);
    EXPECT_EQ(*field.codes.at(0, 0), 255); // far from any chart
  }
}

// Two charts, one dark and one lit, side by side: apart by unknown sub-texels, or touching with owners of their own.
TEST(DistanceField, TakesNothingFromAnotherChart) {
  SunMask touching = makeSunMask(20, 4, [](double x, double) { return x < 0; });
  for (int y = 0; y < 20; ++y)
    for (int x = 10; x < 20; ++x) *touching.owner.at(x, y) = 1;
  SunMask apart = touching;
  std::fill(apart.owner.pixels.begin(), apart.owner.pixels.end(), 0u);
  for (int y = 0; y < 80; ++y)
    for (int x = 36; x < 44; ++x) *apart.sight.at(x, y) = kUnknown;
  SunMask fine = touching; // owners of sub-texels
  fine.owner = base::BasicImage<std::uint32_t>(80, 80, 1, 0);
  for (int y = 0; y < 80; ++y)
    for (int x = 40; x < 80; ++x) *fine.owner.at(x, y) = 1;
  for (const SunMask& mask : {touching, apart, fine}) {
    ASSERT_EQ(findCharts(mask).size(), 2u);
    const DistanceField field = makeDistanceField(mask, {});
    for (int y = 2; y < 18; ++y)
      for (int x = 2; x < 18; ++x) EXPECT_EQ(*field.codes.at(x, y), x < 10 ? 0 : 255) << x << " " << y;
  }
}

// Bilinear reading at a chart's rim meets texels that the chart does not touch.
TEST(DistanceField, GoesOnBesideItsChart) {
  const SunMask mask = makeSunMask(20, 4, [](double x, double) { return x < 0.4; });
  const DistanceFieldOptions options{.sweeps = 0};
  const DistanceField field = makeDistanceField(mask, options);
  for (int x = 2; x < 18; ++x)
    for (const int y : {1, 18}) EXPECT_NEAR(*field.codes.at(x, y), *field.codes.at(x, 10), 1) << x;
  const DistanceFieldError error = measureDistanceField(mask, field, options);
  EXPECT_LT(error.outside, 1e-3); // the rims, too
}

// Within geometry: neither lit nor dark, and no source.
TEST(DistanceField, UnknownSubTexelsAreNoEdges) {
  SunMask mask = makeSunMask(24, 4, [](double x, double) { return x < -4; });
  for (int y = 40; y < 56; ++y)
    for (int x = 60; x < 76; ++x) *mask.sight.at(x, y) = kUnknown; // a box that stands in the light
  const DistanceField field = makeDistanceField(mask, {.sweeps = 0}), open = [] {
    return makeDistanceField(makeSunMask(24, 4, [](double x, double) { return x < -4; }), {.sweeps = 0});
  }();
  EXPECT_EQ(field.codes, open.codes);
  EXPECT_LT(measureDistanceField(mask, makeDistanceField(mask, {}), {}).outside, 1e-3);
}

TEST(DistanceField, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(9);
  SunMask mask = makeSunMask(64, 4, [](double x, double y) { return std::sin(x) + std::cos(0.7 * y) > 0.4; });
  for (std::uint8_t& sight : mask.sight.pixels)
    if (random() % 50 == 0) sight = kUnknown;
  const DistanceField all = makeDistanceField(mask, {});
  const base::ThreadLimit one(1);
  EXPECT_EQ(makeDistanceField(mask, {}).codes, all.codes);
}

TEST(DistanceField, RefusesSizesAndOptionsThatDoNotFit) {
  SunMask mask = makeSunMask(8, 4, [](double x, double) { return x < 0; });
  EXPECT_THROW(makeDistanceField(mask, {.range = 0}), base::Error);
  EXPECT_THROW(makeDistanceField(mask, {.range = 1, .penumbra = 3}), base::Error);
  EXPECT_THROW(makeDistanceField(mask, {.penumbra = std::numeric_limits<double>::quiet_NaN()}), base::Error);
  mask.owner = base::BasicImage<std::uint32_t>(7, 8, 1, 0);
  EXPECT_THROW(makeDistanceField(mask, {}), base::Error);
  EXPECT_THROW(makeVisibilityMask(mask), base::Error);
}

TEST(VisibilityMask, IsTheLitShareOfKnownSubTexels) {
  SunMask mask = makeSunMask(8, 4, [](double x, double) { return x < 0.25; }); // a quarter of texel 4
  for (int y = 12; y < 16; ++y) *mask.sight.at(17, y) = kUnknown;              // of the texel at (4, 3) a lit column
  const base::Image8 visibility = makeVisibilityMask(mask);
  EXPECT_EQ(*visibility.at(3, 4), 0);
  EXPECT_EQ(*visibility.at(4, 4), 191); // 3/4
  EXPECT_EQ(*visibility.at(4, 3), 170); // 2/3
  EXPECT_EQ(*visibility.at(5, 4), 255);
  EXPECT_EQ(*visibility.at(1, 4), 0);   // beside the chart
  EXPECT_EQ(*visibility.at(0, 4), 255); // far from it
}

// The sun on the courtyard's floor and its arch wall, at 16 texels a metre; and of the rods' shadows alone, about 1.1
// texels wide.
TEST(DistanceField, ShowsTheCourtyardWithinTheFiguresAskedFor) {
  constexpr int kDensity = 16, kSize = 8 * kDensity + 4;
  const scenes::Scene yard = scenes::makeBuiltinScene("courtyard");
  scenes::Scene rods = yard;
  std::erase_if(rods.instances, [](const auto& i) { return i.node != "trellis" && i.node != "thin poles"; });
  const lighting::Visibility all(yard), thin(rods);
  const glm::dvec3 towardsSun = -glm::dvec3(yard.lights.front().direction);
  const auto onFloor = [](double x, double y) { return glm::dvec3(x / kDensity, 1e-4, y / kDensity); };
  const auto onWall = [](double x, double y) { return glm::dvec3(-3.7 + 1e-4, 1.45 - y / kDensity, x / kDensity); };
  const auto check = [&](const auto& at, const char* name) {
    const auto isShadowed = [&](double x, double y) { return all.isOccluded(at(x, y), towardsSun); };
    SunMask mask = makeSunMask(kSize, 4, isShadowed);
    SunMask thinMask = makeSunMask(kSize, 4, [&](double x, double y) { return thin.isOccluded(at(x, y), towardsSun); });
    for (std::size_t i = 0; i < mask.sight.pixels.size(); ++i) // what others shade is not the rods'
      if (mask.sight.pixels[i] == kShadowed && thinMask.sight.pixels[i] == kLit) thinMask.sight.pixels[i] = kUnknown;
    expectGood(mask, {}, name);
    expectGood(thinMask, {}, std::string("thin ") + name);
  };
  check(onFloor, "floor");
  check(onWall, "wall");
}

} // namespace
} // namespace parity::bake
