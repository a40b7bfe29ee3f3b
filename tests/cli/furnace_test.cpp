// The white furnace: what the high-end path loses is what its geometry term loses, and compensation gives it back.
#include <algorithm>
#include <cmath>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "scenes/builtin/builtin.h"
#include "shading/quadrature.h"

namespace parity::tests {
namespace {

struct Disc {
  double roughness, mean;
};

class FurnaceTest : public RenderingTest {
protected:
  // Renders builtin:furnace and returns the mean over each sphere's disc. The discs are found through the scene.
  std::vector<Disc> renderDiscs(const std::vector<std::string>& more) const {
    constexpr int kSize = 512;
    const std::string file = path("furnace.exr");
    const RunResult result = runParity(join({{"render", "builtin:furnace", "--path", "highend", "--size", "512x512",
                                              "--background", "0,0,0", "--validation", "-o", file},
                                             more}));
    EXPECT_TRUE(exitedWith(0, result));
    const base::Image image = base::readImage(file);
    const scenes::Scene scene = scenes::makeBuiltinScene("furnace");
    const scenes::Camera& camera = scene.cameras.at(0);
    EXPECT_TRUE(camera.orthographic);
    std::vector<Disc> discs;
    for (const scenes::Instance& instance : scene.instances) {
      const scenes::Mesh& mesh = scene.meshes[instance.mesh];
      double radius = 0;
      for (const glm::vec3& position : mesh.positions) radius = std::max(radius, double{glm::length(position)});
      const glm::vec3 center = glm::vec3(instance.toWorld[3]) - glm::vec3(camera.toWorld[3]);
      double sum = 0;
      int count = 0;
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
          const double dx = ((x + 0.5) / kSize * 2 - 1) * camera.halfHeight - center.x;
          const double dy = (1 - (y + 0.5) / kSize * 2) * camera.halfHeight - center.y;
          // The mesh is a polyhedron: the outermost two thousandths of the radius may show the background.
          if (std::hypot(dx, dy) > 0.998 * radius) continue;
          const float* rgb = image.at(x, y);
          EXPECT_GT(rgb[0], 0) << "the disc is not where the scene says: " << x << "," << y;
          EXPECT_TRUE(rgb[0] == rgb[1] && rgb[1] == rgb[2]) << "a white sphere has a colour: " << x << "," << y;
          sum += rgb[0];
          ++count;
        }
      EXPECT_GT(count, 5000);
      discs.push_back({scene.materials[mesh.material].roughness, sum / count});
    }
    EXPECT_EQ(discs.size(), 11u);
    return discs;
  }

  void expectLosses(const std::string& term, Geometry geometry) const {
    for (const Disc& disc : renderDiscs({"--compensation", "none", "--geometry-term", term}))
      EXPECT_NEAR(disc.mean, hemisphericalAlbedo(geometry, disc.roughness), 0.01)
          << term << ", roughness " << disc.roughness;
  }

  // The integral of E(mu) 2 mu dmu at F0 = 1: the mean over the disc of a sphere seen by parallel rays. A mirror below
  // roughness 0.02: its loss is under 1e-4.
  static double hemisphericalAlbedo(Geometry geometry, double roughness) {
    if (roughness < 0.02) return 1;
    const GaussRule rule(24);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double mu = 0.5 * (rule.nodes[i] + 1);
      const EnvBrdf brdf = integrateEnvBrdf(geometry, roughness, mu);
      sum += 0.5 * rule.weights[i] * (brdf.A + brdf.B) * 2 * mu;
    }
    return sum;
  }
};

// docs/shading.md 5, in per cent: the quadrature that the pictures are held against meets the losses given there. It is
// converged to 0.001; the table is off by up to 0.12 (also in tests/shading).
TEST_F(FurnaceTest, QuadratureMeetsThePublishedLosses) {
  const double roughness[] = {.2, .4, .6, .8, 1}, a[] = {3.6, 13.0, 27.8, 45.4, 62.3},
               b[] = {.6, 5.9, 19.8, 39.7, 59.1};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(100 * (1 - hemisphericalAlbedo(Geometry::schlickSmith, roughness[i])), a[i], 0.15);
    EXPECT_NEAR(100 * (1 - hemisphericalAlbedo(Geometry::heightCorrelated, roughness[i])), b[i], 0.15);
  }
}

TEST_F(FurnaceTest, LossWithoutCompensationIsThatOfHeightCorrelatedSmith) {
  expectLosses("height-correlated", Geometry::heightCorrelated);
}

TEST_F(FurnaceTest, LossWithoutCompensationIsThatOfSchlickSmith) {
  expectLosses("schlick-smith", Geometry::schlickSmith);
}

TEST_F(FurnaceTest, CompensationGivesBackAllButOnePercent) {
  for (const char* term : {"height-correlated", "schlick-smith"})
    for (const Disc& disc : renderDiscs({"--geometry-term", term}))
      EXPECT_NEAR(disc.mean, 1, 0.01) << term << ", roughness " << disc.roughness;
}

} // namespace
} // namespace parity::tests
