// capture, lightmap.
#include "study/stress/table_parts.h"

#include <cmath>
#include <limits>

namespace parity::stress {

using namespace parts;

namespace {

// Three numbers in [low, high]; often a component is 0, as a direction's along an axis.
void put3(Random& random, Row& row, int at, double low, double high) {
  for (int c = 0; c < 3; ++c) row[at + c] = random() % 8 == 0 ? 0 : low + (high - low) * (random() * 0x1p-32);
}

// A direction r of light, |r| <= 1, then two normals.
Row lightAndNormals(Random& random) {
  Row row = directions(3)(random);
  const double share = random() % 8 == 0 ? 0 : random() * 0x1p-32;
  for (int c = 0; c < 3; ++c) row[c] *= share;
  return row;
}

Row pointInBox(Random& random) {
  Row row = directions(2)(random);
  put3(random, row, 0, -3, 3);
  put3(random, row, 6, -4, -1);
  put3(random, row, 9, 1, 4);
  put3(random, row, 12, -1, 1);
  return row;
}

Row texelAndScales(Random& random) {
  Row row = directions(3)(random);
  for (int i = 0; i < 6; ++i) row[i] = std::fabs(row[i]);
  for (int i = 9; i < 13; ++i) row[i] = random() * 0x1p-32;
  row[11] *= 2;
  row[12] = -row[12];
  return row;
}

std::vector<FunctionCase> lightmapFunctions() {
  // What is told apart: a black point, over the least weight of a channel.
  constexpr double kDark = 1.0 / 256 / 0.11;
  return {
      entry("GetLightMapColorLQ", kFnGetLightMapColorLQ, texelAndScales,
            {16, 16, 4 * kDark, "exp2; 2^-8 is subtracted from a number close to it"})
          .takes(join({rgb(unit(0, "Lightmap0")),
                       rgb(unit(3, "Lightmap1")),
                       {wide(direction(6, "WorldNormal")), wide(unit(9, "Scale0")), wide(within(10, "Add0", 0, 0.375)),
                        wide(within(11, "Scale1", 0, 2)), wide(within(12, "Add1", -1, 0))}}))
          .gives(4, first(4))
          .relativeTo(1.0 / 256),
      entry("encodeLightmapLogRgb", kFnEncodeLightmapLogRgb, radiance, {32, 8, 0.0625, "log2, near 1 in the dark"})
          .takes(rgb(wide(powers(0, "C", 0, 1e30, 0x1p-30, 0x1p16))))
          .gives(3, first(3))
          .relativeTo(kCode)
          .increases("C.r"),
      entry("encodeLightmapSh", kFnEncodeLightmapSh, directions(3))
          .takes(join({rgb(wide(within(0, "l1", -1.7, 1.7))),
                       {wide(direction(3, "N0")), wide(powers(6, "l0", 1, 1e6, 1, 1e6))}}))
          .gives(6, 0b111000)
          .relativeTo(0.28),
      entry("decodeOfEncodedLightmap", kFnLightmapRoundTrip, uniforms(3, 0, 200), {64, 64, 1.0 / 256, "exp2 of log2"})
          .takes(rgb(wide(powers(0, "C", 0, 256, 0x1p-20, 256))))
          .gives(4, first(4))
          .relativeTo(1.0 / 256),
      entry("distanceFieldShadow", kFnDistanceFieldShadow, uniforms(2, 0, 1))
          .takes({unit(0, "DistanceField"), wide(powers(1, "TransitionScale", 0x1p-4, 256, 0x1p-4, 256))})
          .gives(1, 1, 1)
          .relativeTo(1)
          .increases("DistanceField"),
      entry("encodeLightmapDirection", kFnEncodeLightmapDirection, uniforms(4, -1, 1))
          .takes(join({rgb(wide(within(0, "l1", -1e6, 1e6))), {wide(powers(3, "l0", 0, 1e6, 0x1p-20, 1e6))}}))
          .gives(3)
          .relativeTo(1),
      entry("directionalLightmapRatio", kFnDirectionalLightmapRatio, lightAndNormals, {32, 16, 64, "pow"})
          .takes(join({rgb(wide(within(0, "r", -1, 1))), {wide(direction(3, "n")), wide(direction(6, "N0"))}}))
          .gives(2, first(2))
          .relativeTo(1),
  };
}

std::vector<FunctionCase> captureFunctions() {
  return {
      entry("boxParallax", kFnBoxParallax, pointInBox)
          .takes(join({rgb(wide(within(0, "position", -4, 4))),
                       {wide(direction(3, "direction"))},
                       rgb(wide(within(6, "lower", -1e6, -1))),
                       rgb(wide(within(9, "upper", 1, 1e6))),
                       rgb(wide(within(12, "origin", -1, 1)))}))
          .gives(3)
          .relativeTo(1),
      entry("captureWeight", kFnCaptureWeight, uniforms(2, 0, 4))
          .takes({wide(powers(0, "d", 0, 1e6, 0x1p-12, 1e6)), wide(powers(1, "R", 0, kInf, 0x1p-10, 0x1p20))})
          .gives(1, 1)
          .decreases("d")
          .increases("R"),
  };
}

} // namespace

std::vector<FunctionCase> bakedFunctions() {
  std::vector<FunctionCase> all = lightmapFunctions();
  for (FunctionCase& function : captureFunctions()) all.push_back(std::move(function));
  return all;
}

} // namespace parity::stress
