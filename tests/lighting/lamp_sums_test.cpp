// The light of a tree of lamps in the levels: against the sum over its leaves, and in a tile against each direction
// alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lighting/environment/cube.h"
#include "lighting/environment/lamp_steps.h"
#include "lighting/environment/lamp_sums.h"
#include "lighting/environment/panorama.h"
#include "scenes/builtin/builtin.h"
#include "shading/shading.h"

namespace parity::lighting {
namespace {

// A grey sky of 1 with a lamp of `cells` squared, of 50.
LampTree makeLamp(int cells) {
  scenes::Environment environment;
  environment.name = "lamp";
  environment.radiance = base::Image(512, 256, 3);
  std::fill(environment.radiance.pixels.begin(), environment.radiance.pixels.end(), 1.f);
  for (int y = 90; y < 90 + cells; ++y)
    for (int x = 200; x < 200 + cells; ++x)
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = 50;
  Panorama panorama = makePanorama(environment, 64);
  return takeLamps(panorama).wide;
}

LampTree lampsOf(const char* builtin) {
  Panorama panorama = makePanorama(scenes::makeBuiltinEnvironment(builtin), 64);
  return takeLamps(panorama).wide;
}

double filteredLight(const LampNode& node, const glm::dvec3& direction, double a2) {
  const glm::dvec3 d = glm::dvec3(node.direction) - direction;
  return node.light.y *
         shading::f64::prefilteredLobe(a2, shading::f64::prefilteredLobeIntegral(a2), glm::dot(d, d) / 4, node.spread);
}

double lightOfLeaves(const LampTree& tree, const glm::dvec3& direction, double a2) {
  double sum = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    if (tree.isLeaf(i)) sum += filteredLight(tree.nodes[i], direction, a2);
  return sum;
}

FourLampSums makeFour(const std::vector<glm::vec3>& directions) {
  FourLampSums four;
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) four.direction[c][i] = directions[i][c];
  return four;
}

// Directions .002 apart, from `angle` to the lamp on.
std::vector<glm::vec3> directionsAt(const LampTree& tree, double angle) {
  const glm::dvec3 lamp(tree.nodes[0].direction), side = glm::normalize(glm::cross(lamp, glm::dvec3(0, 1, 0)));
  std::vector<glm::vec3> directions;
  for (int i = 0; i < 4; ++i)
    directions.emplace_back(std::cos(angle + 0.002 * i) * lamp + std::sin(angle + 0.002 * i) * side);
  return directions;
}

// As a point where it is far and by a mean over its cell where it is near.
TEST(LampSums, AreThoseOfTheLeaves) {
  const LampTree tree = makeLamp(24);
  for (const double roughness : {0.1, 0.3, 0.6, 1.0}) {
    const double a2 = std::pow(roughness, 4);
    // The lamp is .28 radians wide: at 1.5 and 1.6 the horizon cuts it.
    for (const double angle : {0.0, 0.1, 0.3, 0.8, 1.3, 1.5, 1.6, 2.0}) {
      const std::vector<glm::vec3> directions = directionsAt(tree, angle);
      FourLampSums four = makeFour(directions);
      addLamps(tree, static_cast<float>(a2), findLampSteps(tree, static_cast<float>(a2), directions), {&four, 1});
      for (int i = 0; i < 4; ++i) {
        const double expected = lightOfLeaves(tree, glm::dvec3(directions[i]), a2);
        EXPECT_NEAR(four.sum[1][i], expected, 0.03 * expected + 1e-9) << roughness << " " << angle;
      }
    }
  }
}

// One node for the whole lamp: without a mean over the cosine it would have nothing at the horizon and below, and too
// little above.
TEST(LampSums, TakeAMeanWhereTheHorizonCutsANode) {
  const LampTree tree = makeLamp(8); // .05 radians to each side
  const float a2 = 0.25f;
  const double whole = lightOfLeaves(tree, glm::dvec3(directionsAt(tree, 1.4)[0]), a2);
  for (const double angle : {1.48, 1.53, 1.57, 1.6}) {
    const std::vector<glm::vec3> directions = directionsAt(tree, angle);
    FourLampSums four = makeFour(directions);
    addLamps(tree, a2, {.smooth = {}, .taken = {0}, .walked = {}}, {&four, 1});
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(four.sum[1][i], lightOfLeaves(tree, glm::dvec3(directions[i]), a2), 0.012 * whole) << angle;
  }
}

// A tile of a level of `size`, and its texels' directions.
struct Tile {
  TexelTile place;
  std::vector<glm::vec3> normals;
  Tile(int face, int left, int top, int side, int size) : place{face, left, top, side, size} {
    for (int i = 0; i < side * side; ++i)
      normals.emplace_back(texelDirection(face, left + i % side, top + i / side, size));
  }
};

const std::vector<Tile> kTiles = {{0, 0, 0, 16, 64},    {2, 16, 32, 16, 64},  {3, 48, 48, 16, 64},
                                  {5, 96, 16, 16, 128}, {4, 0, 112, 16, 256}, {1, 8, 0, 8, 32},
                                  {2, 4, 4, 4, 16},     {0, 0, 0, 2, 2},      {3, 0, 0, 1, 1}};

// Each leaf is below one step, or under the horizon of all directions.
TEST(LampSteps, LeaveOutOnlyWhatIsUnderTheHorizon) {
  const LampTree tree = lampsOf("studio");
  std::size_t leftOut = 0;
  for (const Tile& tile : kTiles) {
    const LampSteps steps = findLampSteps(tree, 0.01f, tile.normals);
    std::vector<int> times(tree.nodes.size());
    for (const auto* list : {&steps.smooth, &steps.taken, &steps.walked})
      for (const std::uint32_t node : *list)
        for (std::uint32_t i = node; i < tree.nodes[node].next; ++i) ++times[i];
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      if (!tree.isLeaf(i)) continue;
      ASSERT_LE(times[i], 1);
      if (times[i] == 1) continue;
      ++leftOut;
      for (const glm::vec3& normal : tile.normals) ASSERT_LE(glm::dot(normal, tree.nodes[i].direction), 0);
    }
  }
  EXPECT_GT(leftOut, tree.nodes.size());
}

// Against sixteen directions that are alone, whose lamps are not interpolated. They open fewer nodes: kLampOpening's
// error.
TEST(LampSums, OfATileAreThoseOfItsDirections) {
  for (const char* environment : {"studio", "sky"}) {
    const LampTree tree = lampsOf(environment);
    std::size_t smooth = 0, walked = 0;
    for (const Tile& tile : kTiles)
      for (const float a2 : {1e-5f, 1e-3f, 0.03f, 0.5f}) {
        std::vector<glm::vec3> sums(tile.normals.size(), glm::vec3(1.f));
        addLampsToTile(tree, tile.place, tile.normals, a2, sums);
        const LampSteps steps = findLampSteps(tree, a2, tile.normals);
        if (tile.place.side >= 8) smooth += steps.smooth.size();
        walked += steps.walked.size();
        for (std::size_t i = 0; i < sums.size(); i += 7) {
          const std::vector<glm::vec3> alone(4, tile.normals[i]);
          FourLampSums four = makeFour(alone);
          addLamps(tree, a2, findLampSteps(tree, a2, alone), {&four, 1});
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sums[i][c] - 1, four.sum[c][0], 0.01f * four.sum[c][0] + 1e-5f)
                << environment << " " << tile.place.face << " " << tile.place.faceSize << " " << a2 << " " << i;
        }
      }
    EXPECT_GT(smooth, 1000u);
    EXPECT_GT(walked, 100u);
  }
}

// One lamp as near as a smooth one may be, where polynomials err most: findLampSteps (kFar) promises a thousandth of
// its light at the brightest texel.
TEST(LampSums, OfTheNearestSmoothLampAreAPolynomial) {
  int smooth = 0;
  for (const Tile& tile : kTiles) {
    if (tile.place.side < 8) continue;
    glm::dvec3 mean(0.0);
    for (const glm::vec3& normal : tile.normals) mean += glm::dvec3(normal) / static_cast<double>(tile.place.count());
    double radius = 0;
    for (const glm::vec3& normal : tile.normals) radius = std::max(radius, glm::distance(glm::dvec3(normal), mean));
    const glm::dvec3 middle = glm::normalize(mean), right = glm::normalize(glm::cross(middle, glm::dvec3(0.3, 1, 0.2))),
                     up = glm::cross(right, middle);
    for (const double azimuth : {0.0, 0.8, 2.0, 4.0})
      for (const float a2 : {1e-5f, 1e-4f, 1e-3f}) {
        // Found by steps: the first angle at which the lamp is smooth.
        for (double angle = 2 * radius; angle < 1.5; angle += 0.01 * radius) {
          const glm::dvec3 direction =
              std::cos(angle) * middle + std::sin(angle) * (std::cos(azimuth) * right + std::sin(azimuth) * up);
          const LampTree tree{
              {{.direction = glm::vec3(direction), .spread = 1e-7f, .light = glm::vec3(1.f), .next = 1}}};
          const LampSteps steps = findLampSteps(tree, a2, tile.normals);
          if (steps.smooth.empty()) continue;
          ++smooth;
          std::vector<glm::vec3> sums(tile.normals.size(), glm::vec3(0.f));
          addLampsToTile(tree, tile.place, tile.normals, a2, sums);
          double brightest = 0, worst = 0;
          for (std::size_t i = 0; i < sums.size(); ++i) {
            const double expected = filteredLight(tree.nodes[0], glm::dvec3(tile.normals[i]), static_cast<double>(a2));
            brightest = std::max(brightest, expected);
            worst = std::max(worst, std::abs(static_cast<double>(sums[i].y) - expected));
          }
          EXPECT_LT(worst, 1e-3 * brightest)
              << tile.place.face << " " << tile.place.faceSize << " " << azimuth << " " << a2;
          break;
        }
      }
  }
  EXPECT_GT(smooth, 30);
}

TEST(LampSums, OfNoLampsStay) {
  const Tile& tile = kTiles.front();
  std::vector<glm::vec3> sums(tile.normals.size(), glm::vec3(2.f));
  addLampsToTile({}, tile.place, tile.normals, 0.1f, sums);
  for (const glm::vec3& sum : sums) EXPECT_EQ(sum, glm::vec3(2.f));
}

// The same nodes at all texels, once interpolated and once not.
TEST(LampSums, OfSmoothNodesAreAPolynomial) {
  const LampTree tree = lampsOf("studio");
  std::size_t smoothNodes = 0;
  for (const Tile& tile : kTiles) {
    const int side = tile.place.side;
    if (side < 8) continue;
    for (const float a2 : {1e-5f, 1e-3f, 0.03f, 0.5f}) {
      const LampSteps steps = findLampSteps(tree, a2, tile.normals);
      smoothNodes += steps.smooth.size();
      std::vector<glm::vec3> sums(tile.normals.size(), glm::vec3(0.f));
      addLampsToTile(tree, tile.place, tile.normals, a2, sums);
      for (int square = 0; square < side * side / 16; ++square) {
        const int first = square / (side / 4) * 4 * side + square % (side / 4) * 4;
        std::vector<FourLampSums> all, smooth;
        for (int y = 0; y < 4; ++y) {
          const auto row = tile.normals.begin() + first + y * side;
          all.push_back(makeFour({row, row + 4}));
        }
        smooth = all;
        addLamps(tree, a2, steps, all);
        addLamps(tree, a2, {.smooth = {}, .taken = steps.smooth, .walked = {}}, smooth);
        for (int i = 0; i < 16; ++i)
          EXPECT_NEAR(sums[first + i / 4 * side + i % 4].y, all[i / 4].sum[1][i % 4],
                      3e-4f * smooth[i / 4].sum[1][i % 4] + 1e-6f * all[i / 4].sum[1][i % 4])
              << a2;
      }
    }
  }
  EXPECT_GT(smoothNodes, 1000u);
}

} // namespace
} // namespace parity::lighting
