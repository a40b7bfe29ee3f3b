#include "study/stress/random_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::stress {

namespace {

double uniform(Random& random, double low, double high) { return low + (high - low) * (random() * 0x1p-32); }

// Often 0 or 1, else in between: the ends are where guards act.
double unitShare(Random& random) {
  const auto pick = random() % 16;
  return pick == 0 ? 0.0 : pick == 1 ? 1.0 : uniform(random, 0, 1);
}

void putDirection(Random& random, Row& row, int at) {
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 6.2831853);
  row[at] = std::sqrt(1 - z * z) * std::cos(phi);
  row[at + 1] = std::sqrt(1 - z * z) * std::sin(phi);
  row[at + 2] = z;
}

} // namespace

// The first `count` inputs in [low, high].
Maker uniforms(int count, double low, double high) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) row[i] = uniform(random, low, high);
    return row;
  };
}

// The first `count` inputs in [0, 1], ends included.
Maker units(int count) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) row[i] = unitShare(random);
    return row;
  };
}

// Roughness in [low, 1], then a cosine in [cosineLow, 1] that is near 1 (within a smooth lobe) half of the time.
Maker lobe(double low, double cosineLow) {
  return [=](Random& random) {
    Row row{};
    row[0] = uniform(random, low, 1);
    const double width = random() % 2 == 0 ? 1 : std::pow(row[0], 4);
    row[1] = std::max(cosineLow, 1 - width * uniform(random, 0, 3));
    return row;
  };
}

// Roughness in [0, 1], within 1e-3 of 1 half of the time, where log2 is least exact.
Row roughnessNearOne(Random& random) {
  Row row{};
  row[0] = random() % 2 == 0 ? unitShare(random) : uniform(random, 0.999, 1);
  return row;
}

Row normalAndCoefficients(Random& random) {
  Row row{};
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 6.2831853);
  row[0] = std::sqrt(1 - z * z) * std::cos(phi);
  row[1] = std::sqrt(1 - z * z) * std::sin(phi);
  row[2] = z;
  for (int i = 3; i < 30; ++i) row[i] = uniform(random, -2, 4);
  return row;
}

Row distanceAndRange(Random& random) {
  Row row{};
  row[0] = random() % 16 == 0 ? 0.0 : std::exp2(uniform(random, -20, 15)); // squared distance
  row[1] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -3, 10));
  if (random() % 16 == 0) row[1] = std::numeric_limits<double>::infinity();
  return row;
}

Row distanceRangeAndExponent(Random& random) {
  Row row{};
  row[1] = std::exp2(uniform(random, -3, 10));
  row[0] = row[1] * row[1] * uniform(random, 0, 1.25); // squared distance
  row[2] = std::exp2(uniform(random, -1, 5));
  return row;
}

Row spotCosines(Random& random) {
  Row row{};
  row[0] = uniform(random, -1, 1);
  row[2] = uniform(random, -1, 1);
  row[1] = random() % 8 == 0 ? row[2] : uniform(random, row[2], 1); // inner = outer now and then
  if (random() % 2 == 0) row[0] = uniform(random, row[2], row[1]);
  return row;
}

// Vectors of any length that fp32 or, for half, fp16 holds; zero, NaN and infinite ones too.
Row vectorAndFallback(Random& random) {
  Row row{};
  const double length = std::exp2(uniform(random, -13, 15));
  for (int i = 0; i < 3; ++i) row[i] = length * uniform(random, -1, 1);
  const auto pick = random() % 16;
  if (pick == 0) row[0] = row[1] = row[2] = 0;
  if (pick == 1) row[random() % 3] = std::numeric_limits<double>::quiet_NaN();
  if (pick == 2) row[random() % 3] = std::numeric_limits<double>::infinity();
  row[5] = 1;
  return row;
}

// `count` unit vectors, one after the other.
Maker directions(int count) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) putDirection(random, row, 3 * i);
    return row;
  };
}

// Base colour, dielectric F0, roughness, N, V, L, the preset, fully rough, metallic.
Row litPoint(Random& random) {
  Row row{};
  for (int i = 0; i < 6; ++i) row[i] = unitShare(random);
  row[6] = uniform(random, 0.0626, 1);
  for (const int at : {7, 10, 13}) putDirection(random, row, at);
  for (const int at : {16, 17, 18}) row[at] = unitShare(random);
  return row;
}

// Roughness and NoH within a lobe, VoH, colours, NoL and NoV.
Row litLobe(Random& random) {
  Row row = lobe(0.015625, 0)(random);
  for (int i = 2; i < 14; ++i) row[i] = unitShare(random);
  return row;
}

// The way to a light of up to 1e6 candela, its range, axis and cone.
Row localLight(Random& random) {
  Row row{};
  const double distance = std::exp2(uniform(random, -8, 10));
  putDirection(random, row, 0);
  for (int i = 0; i < 3; ++i) row[i] *= distance;
  for (int i = 3; i < 6; ++i) row[i] = std::exp2(uniform(random, -20, 15));
  row[6] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -3, 10));
  row[7] = unitShare(random);
  putDirection(random, row, 8);
  row[12] = uniform(random, -1, 1);
  row[11] = uniform(random, row[12], 1);
  row[13] = unitShare(random);
  return row;
}

// Radiance over the whole range of RGBM and beyond, black too.
Row radiance(Random& random) {
  Row row{};
  for (int i = 0; i < 3; ++i) row[i] = random() % 8 == 0 ? 0.0 : std::exp2(uniform(random, -14, 10));
  return row;
}

// Fog from thin to thick, ways from a decimetre to kilometres, up, down and level.
Row fogAndWay(Random& random) {
  Row row{};
  row[0] = random() % 16 == 0 ? 0.0 : std::exp2(uniform(random, -12, 2));
  row[1] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -10, 3));
  row[2] = uniform(random, -50, 50);
  row[3] = random() % 2 == 0 ? 0.0 : uniform(random, 0, 100);
  row[4] = unitShare(random);
  row[5] = uniform(random, -100, 100);
  row[7] = std::exp2(uniform(random, -4, 12));
  row[6] = row[7] * (random() % 8 == 0 ? 0.0 : uniform(random, -1, 1));
  return row;
}

// Five in [0, 1], ends included; a depth, and a distance with the share of it over which a shadow fades, at least a
// twentieth: over less the fade is an edge, and a depth's last digit is all of it.
Row shadowAndFade(Random& random) {
  Row row = units(5)(random);
  row[5] = uniform(random, 0, 2);
  row[6] = uniform(random, 0.5, 2);
  row[7] = uniform(random, 0.05, 1);
  return row;
}

} // namespace parity::stress
