// CIEDE2000 against the published pairs and the formula in double precision; CIELAB against known colours.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "compare/metrics/ciede2000.h"
#include "compare/metrics/measure.h"

namespace parity::compare {
namespace {

struct Lab {
  double l, a, b;
};

struct Published {
  Lab first, second;
  double difference;
};

// Sharma, Wu, Dalal 2005, table 1.
constexpr std::array<Published, 34> kPublished = {{
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
    {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
}};

// The formula as the paper writes it, with angles (equations 2-22).
double formula(const Lab& x, const Lab& y) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto pow7 = [](double v) { return std::pow(v, 7); };
  const double meanC = (std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2;
  const double g = 0.5 * (1 - std::sqrt(pow7(meanC) / (pow7(meanC) + pow7(25))));
  const double a1 = (1 + g) * x.a, a2 = (1 + g) * y.a;
  const double c1 = std::hypot(a1, x.b), c2 = std::hypot(a2, y.b);
  const auto hue = [&](double a, double b) {
    if (a == 0 && b == 0) return 0.;
    const double h = std::atan2(b, a) / kDegree;
    return h < 0 ? h + 360 : h;
  };
  const double h1 = hue(a1, x.b), h2 = hue(a2, y.b);
  const double dL = y.l - x.l, dC = c2 - c1;
  double dh = 0, h = h1 + h2;
  if (c1 * c2 != 0) {
    dh = h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    h = std::fabs(h1 - h2) <= 180 ? (h1 + h2) / 2 : h1 + h2 < 360 ? (h1 + h2 + 360) / 2 : (h1 + h2 - 360) / 2;
  }
  const double dH = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree);
  const double l = (x.l + y.l) / 2, c = (c1 + c2) / 2;
  const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                   0.32 * std::cos((3 * h + 6) * kDegree) - 0.20 * std::cos((4 * h - 63) * kDegree);
  const double theta = 30 * std::exp(-std::pow((h - 275) / 25, 2));
  const double rc = 2 * std::sqrt(pow7(c) / (pow7(c) + pow7(25)));
  const double sl = 1 + 0.015 * std::pow(l - 50, 2) / std::sqrt(20 + std::pow(l - 50, 2));
  const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t, rt = -std::sin(2 * theta * kDegree) * rc;
  const double u = dL / sl, v = dC / sc, w = dH / sh;
  return std::sqrt(u * u + v * v + w * w + rt * v * w);
}

double difference(const Lab& x, const Lab& y) {
  float first[3] = {static_cast<float>(x.l), static_cast<float>(x.a), static_cast<float>(x.b)},
        second[3] = {static_cast<float>(y.l), static_cast<float>(y.a), static_cast<float>(y.b)}, out = 0;
  ciede2000Row({first, first + 1, first + 2}, {second, second + 1, second + 2}, 1, &out);
  return static_cast<double>(out);
}

TEST(Ciede2000, IsThePublishedValueOfAll34PairsEitherWayRound) {
  for (const Published& pair : kPublished) {
    EXPECT_NEAR(formula(pair.first, pair.second), pair.difference, 5e-5); // the oracle itself
    EXPECT_NEAR(difference(pair.first, pair.second), pair.difference, 1e-4) << pair.first.a << ", " << pair.first.b;
    EXPECT_NEAR(difference(pair.second, pair.first), pair.difference, 1e-4) << pair.first.a << ", " << pair.first.b;
  }
}

TEST(Ciede2000, IsTheFormulaInDoublePrecisionOnRandomColours) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> lightness(0, 100), chroma(-110, 110), close(-2, 2);
  for (int i = 0; i < 200000; ++i) {
    // As floats, so that both see the same colours.
    const auto round = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    const Lab x{round(lightness(random)), round(chroma(random)), round(chroma(random))};
    const Lab y = i % 2 == 0 ? Lab{round(lightness(random)), round(chroma(random)), round(chroma(random))}
                             : Lab{round(x.l + close(random)), round(x.a + close(random)), round(x.b + close(random))};
    const double exact = formula(x, y);
    ASSERT_NEAR(difference(x, y), exact, 1e-4 * std::max(1., exact / 10))
        << x.l << " " << x.a << " " << x.b << " and " << y.l << " " << y.a << " " << y.b;
  }
}

TEST(Ciede2000, IsZeroForEqualColoursAndTheLightnessForGreys) {
  EXPECT_EQ(difference({50, 20, -30}, {50, 20, -30}), 0);
  EXPECT_EQ(difference({0, 0, 0}, {0, 0, 0}), 0);
  EXPECT_NEAR(difference({0, 0, 0}, {100, 0, 0}), 100, 1e-4); // SL = 1 at L = 50
}

// Of the sRGB primaries by the exact matrix of IEC 61966-2-1's chromaticities (B. Lindbloom's calculator, D65).
TEST(Lab, OfKnownColoursIsThePublishedOne) {
  struct Known {
    float rgb[3];
    double l, a, b;
  };
  for (const Known& known :
       {Known{{1, 1, 1}, 100, 0, 0}, Known{{0, 0, 0}, 0, 0, 0}, Known{{1, 0, 0}, 53.2408, 80.0925, 67.2032},
        Known{{0, 1, 0}, 87.7347, -86.1827, 83.1793}, Known{{0, 0, 1}, 32.2970, 79.1875, -107.8602}}) {
    float lab[3];
    labRow(known.rgb, 1, {lab, lab + 1, lab + 2});
    EXPECT_NEAR(static_cast<double>(lab[0]), known.l, 0.01);
    EXPECT_NEAR(static_cast<double>(lab[1]), known.a, 0.03);
    EXPECT_NEAR(static_cast<double>(lab[2]), known.b, 0.03);
  }
}

TEST(DeltaE, PoolsTheDifferencesOfDisplayedPixels) {
  base::Image reference(4, 1, 3, 0.f), test(4, 1, 3, 0.f);
  for (int c = 0; c < 3; ++c) test.at(3, 0)[c] = 1.f;
  const base::PixelList list{"m", {0, 1, 2, 3}, {}};
  const Figures f =
      measureRegions({reference, test}, {list}, {.metrics = {"deltae"}, .statistics = {"deltae.fraction_over(2.3)"}})
          .regions[0];
  EXPECT_NEAR(f.find("deltae.mean").value(), 25, 1e-4);
  EXPECT_NEAR(f.find("deltae.max").value(), 100, 1e-4);
  EXPECT_NEAR(f.find("deltae.p95").value(), 100, 1e-4);
  EXPECT_EQ(f.find("deltae.fraction_over(2.3)"), 0.25);
}

// What a pixel that is not finite enters as has to be more than any two displayed colours differ by.
TEST(DeltaE, NoTwoDisplayedColoursAreAsFarApartAsTheWorst) {
  std::vector<float> linear;
  for (int i = 0; i < 9 * 9 * 9; ++i)
    for (const int k : {i % 9, i / 9 % 9, i / 81}) linear.push_back(std::pow(static_cast<float>(k) / 8.f, 2.2f));
  const std::size_t n = linear.size() / 3;
  std::vector<float> l(n), a(n), b(n), out(n);
  labRow(linear.data(), static_cast<int>(n), {l.data(), a.data(), b.data()});
  float most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<float> l1(n, l[i]), a1(n, a[i]), b1(n, b[i]);
    ciede2000Row({l1.data(), a1.data(), b1.data()}, {l.data(), a.data(), b.data()}, static_cast<int>(n), out.data());
    most = std::max(most, *std::max_element(out.begin(), out.end()));
  }
  EXPECT_GT(most, 100.f);
  base::Image reference(1, 1, 3, std::numeric_limits<float>::infinity()), test(1, 1, 3);
  const Figures f = measureRegions({reference, test}, {{"m", {0}, {}}}, {.metrics = {"deltae"}}).regions[0];
  EXPECT_GT(f.find("deltae.mean").value(), static_cast<double>(most));
}

} // namespace
} // namespace parity::compare
