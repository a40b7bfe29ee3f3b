// What a ray finds on a surface: normals, the smooth surface above facets, and the material's values there.
#include "lighting/surface/surface_material.h"

#include <gtest/gtest.h>

#include <random>

#include "shading/shading.h"
#include "support/matte_scenes.h"
#include "support/small_scenes.h"

namespace parity::lighting {
namespace {

using namespace parity::tests;

// A chord's point is as far below the circle as its sagitta: on a cylinder of radius 1 with facets of angle 2 a the
// middle of a facet is 1 - cos a below, and the tangent planes there are at height sin a tan a above it, whose normals
// lean by a.
TEST(SurfacePoint, LiftReachesTheTangentPlanesOfConvexFacetsAlone) {
  const float a = 0.3f;
  scenes::Scene scene;
  scenes::Mesh facet;
  facet.positions = {{-std::sin(a), std::cos(a), 1}, {std::sin(a), std::cos(a), 1}, {0, std::cos(a), -1}};
  facet.normals = {{-std::sin(a), std::cos(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 1, 0}};
  facet.indices = {0, 1, 2};
  scenes::Material material = matte("facet", 0.5f);
  material.doubleSided = true;
  addObject(scene, facet, material);
  const Visibility visibility(scene);
  // In the middle of the edge between the first two vertices each tangent plane is sin^2 a above; w = 1/2 each.
  const auto at = [&](const glm::dvec3& from, const glm::dvec3& direction) {
    const auto hit = visibility.firstHit(from, direction);
    EXPECT_TRUE(hit.has_value());
    return surfacePointAt(scene, *hit, direction);
  };
  const SurfacePoint above = at({0, 3, 1 - 1e-6}, {0, -1, 0});
  const double s = std::sin(a), c = std::cos(a);
  EXPECT_NEAR(above.lift.x, 0, 1e-5);
  EXPECT_NEAR(above.lift.y, s * s * c, 1e-5);
  EXPECT_NEAR(above.smooth.y, 1, 1e-6);
  EXPECT_NEAR(above.position.y, c, 1e-6);
  // From below it is concave.
  const SurfacePoint below = at({0, -3, 1 - 1e-6}, {0, 1, 0});
  EXPECT_EQ(below.lift, glm::dvec3(0));
  EXPECT_NEAR(below.smooth.y, -1, 1e-6);
  EXPECT_NEAR(below.geometric.y, -1, 1e-6);
  // At a vertex none is left.
  EXPECT_NEAR(glm::length(at({-s + 1e-5, 3, 1 - 1e-5}, {0, -1, 0}).lift), 0, 1e-4);
}

// Everywhere on a coarse sphere, scaled and mirrored: rays above the horizon begin outside of the convex mesh.
TEST(SurfacePoint, RaysFromALiftedPointLeaveAConvexMesh) {
  scenes::Scene scene;
  addObject(scene, scenes::makeSphere(1, 10, 6), matte("ball", 0.5f),
            glm::scale(glm::translate(glm::mat4(1.f), glm::vec3(5, 0, 0)), glm::vec3(-2, 2, 2)));
  const Visibility visibility(scene);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int facets = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 out = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const auto hit = visibility.firstHit(glm::dvec3(5, 0, 0) + 5.0 * out, -out);
    ASSERT_TRUE(hit.has_value());
    const SurfacePoint point = surfacePointAt(scene, *hit, -out);
    ASSERT_NEAR(glm::dot(point.smooth, out), 1, 0.02);
    // Nearly along the horizon: the worst.
    const glm::dvec3 any = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 along = glm::normalize(glm::cross(any, point.smooth)), grazing = along + 1e-3 * point.smooth;
    const glm::dvec3 facet = visibility.leaveSurface(point.position, point.geometric);
    facets += visibility.isOccluded(facet, glm::normalize(grazing));
    EXPECT_FALSE(visibility.isOccluded(facet + point.lift, glm::normalize(grazing))) << i;
  }
  EXPECT_GT(facets, 200) << "without the lift";
}

// A quad of every texture, each half another value, read in the middle of a half.
TEST(SurfaceMaterial, IsFactorsTimesTexturesAtThePoint) {
  scenes::Scene scene = makeQuadScene();
  const auto addTexture = [&](std::array<std::uint8_t, 4> left, std::array<std::uint8_t, 4> right) {
    scenes::TextureImage image{"halves", base::Image8(2, 1, 4)};
    std::copy(left.begin(), left.end(), image.pixels.at(0, 0));
    std::copy(right.begin(), right.end(), image.pixels.at(1, 0));
    scene.images.push_back(image);
    scenes::TextureSlot slot;
    slot.image = static_cast<int>(scene.images.size()) - 1;
    slot.sampler.magFilter = scenes::Filter::nearest;
    return slot;
  };
  scenes::Material& m = scene.materials[0];
  m.baseColor = {0.5f, 0.6f, 0.7f, 1};
  m.metallic = 0.8f;
  m.roughness = 0.9f;
  m.occlusionStrength = 0.5f;
  m.emissive = {2, 3, 4};
  m.specular = 0.6f;
  m.specularColor = {1, 0.5f, 0.25f};
  m.normalScale = 2;
  m.baseColorTexture = addTexture({255, 128, 0, 255}, {0, 128, 255, 255});
  m.metallicRoughnessTexture = addTexture({0, 51, 102, 0}, {0, 204, 153, 0});
  m.occlusionTexture = addTexture({51, 0, 0, 0}, {204, 0, 0, 0});
  m.emissiveTexture = addTexture({188, 0, 255, 0}, {255, 188, 0, 0});
  m.specularTexture = addTexture({0, 0, 0, 51}, {0, 0, 0, 255});
  m.specularColorTexture = addTexture({255, 188, 255, 0}, {188, 255, 0, 0});
  m.normalTexture = addTexture({178, 128, 230, 0}, {128, 77, 230, 0});
  scene.meshes[0].colors.assign(4, {0.5f, 1, 1, 1});
  const Visibility visibility(scene);
  using shading::f64::srgbToLinear;
  const double half = srgbToLinear(128 / 255.0), bright = srgbToLinear(188 / 255.0);
  for (const bool right : {false, true}) {
    for (const double side : {1.0, -1.0}) {
      const auto hit = visibility.firstHit({right ? 0.5 : -0.5, 0.1, 2 * side}, {0, 0, -side});
      ASSERT_TRUE(hit.has_value());
      const SurfaceMaterial at = surfaceMaterialAt(scene, *hit, surfacePointAt(scene, *hit, {0, 0, -side}));
      EXPECT_NEAR(at.baseColor.x, right ? 0 : 0.25, 1e-6);
      EXPECT_NEAR(at.baseColor.y, 0.6 * half, 1e-6);
      EXPECT_NEAR(at.baseColor.z, right ? 0.7 : 0, 1e-6);
      EXPECT_NEAR(at.roughness, 0.9 * (right ? 0.8 : 0.2), 1e-6);
      EXPECT_NEAR(at.metallic, 0.8 * (right ? 0.6 : 0.4), 1e-6);
      EXPECT_NEAR(at.occlusion, 1 + 0.5 * ((right ? 0.8 : 0.2) - 1), 1e-6);
      EXPECT_NEAR(at.emissive.x, 2 * (right ? 1 : bright), 1e-6);
      EXPECT_NEAR(at.emissive.y, 3 * (right ? bright : 0), 1e-6);
      EXPECT_NEAR(at.F90, 0.6 * (right ? 1 : 0.2), 1e-6);
      EXPECT_NEAR(at.F0.x, 0.04 * (right ? bright : 1) * at.F90, 1e-6);
      EXPECT_NEAR(at.F0.y, 0.04 * 0.5 * (right ? 1 : bright) * at.F90, 1e-6);
      // Tangent +X, bitangent +Y; a back turns the whole frame round.
      const double x = right ? 2 * 128 / 255. - 1 : 2 * 178 / 255. - 1,
                   y = right ? 2 * 77 / 255. - 1 : 2 * 128 / 255. - 1, z = 2 * 230 / 255. - 1;
      const glm::dvec3 mapped = glm::normalize(side * glm::dvec3(2 * x, 2 * y, z));
      EXPECT_NEAR(glm::distance(at.normal, mapped), 0, 1e-6) << right << ", " << side;
    }
  }
}

} // namespace
} // namespace parity::lighting
