// Captures against the planes that their rays meet, and against the environment alone.
#include "job/scene/capture_render.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "lighting/environment/cube.h"
#include "lighting/environment/equirect.h"
#include "scenes/builtin/procedural_environment.h"
#include "support/small_scenes.h"

namespace parity::job {
namespace {

constexpr lighting::PrefilterOptions kFilter{.faceSize = 32, .sampleCount = 1};

class CaptureRender : public testing::Test {
protected:
  void SetUp() override {
    if (gpu::listDevices({}).empty()) GTEST_SKIP() << "no Vulkan device";
    const char* name = std::getenv("PARITY_TEST_DEVICE");
    m_settings.device = {.name = name ? name : "", .validation = true};
  }
  // The base texels of a capture.
  std::vector<glm::vec4> capture(PreparedScene prepared, const glm::vec3& position, int samples = 1) {
    const std::array positions = {position};
    prepared.settings = m_settings;
    return renderCaptures(prepared, positions, {.filter = kFilter, .samples = samples}).front().prefiltered.mips[0];
  }
  Settings m_settings;
};

struct Plate {
  glm::dvec3 center, right, up; // half extents
  glm::vec3 color;
};

// An unlit quad of this colour; its front towards right x up.
void addPlate(scenes::Scene& scene, const Plate& plate) {
  const auto index = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(tests::makeQuad(index));
  const glm::dvec3 normal = glm::normalize(glm::cross(plate.right, plate.up));
  scene.instances.push_back(
      {index,
       glm::mat4(glm::vec4(plate.right, 0), glm::vec4(plate.up, 0), glm::vec4(normal, 0), glm::vec4(plate.center, 1)),
       "plate"});
  scenes::Material material;
  material.name = "plate " + std::to_string(index);
  material.baseColor = glm::vec4(plate.color, 1);
  material.unlit = material.doubleSided = true;
  scene.materials.push_back(material);
}

// What a ray meets first, and how far from a plate's rim, in half extents; black where it meets none.
struct Seen {
  glm::vec3 color{0.f};
  double margin = std::numeric_limits<double>::infinity();
};
Seen trace(const std::vector<Plate>& plates, const glm::dvec3& origin, const glm::dvec3& direction) {
  Seen seen;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Plate& plate : plates) {
    const glm::dvec3 normal = glm::cross(plate.right, plate.up);
    const double distance = glm::dot(plate.center - origin, normal) / glm::dot(direction, normal);
    if (!(distance > 0)) continue;
    const glm::dvec3 at = origin + distance * direction - plate.center;
    const double s = std::abs(glm::dot(at, plate.right) / glm::dot(plate.right, plate.right));
    const double t = std::abs(glm::dot(at, plate.up) / glm::dot(plate.up, plate.up));
    seen.margin = std::min(seen.margin, std::abs(std::max(s, t) - 1));
    if (std::max(s, t) > 1 || distance > nearest) continue;
    nearest = distance;
    seen.color = plate.color;
  }
  return seen;
}

// On each side a plate of its own colour, off the middle to one side and upwards, and a small one elsewhere.
TEST_F(CaptureRender, ShowsInEachTexelWhatLiesInItsDirection) {
  const glm::dvec3 position(0.4, -0.3, 0.2);
  std::vector<Plate> plates;
  for (int face = 0; face < lighting::kCubeFaces; ++face) {
    const glm::dvec3 axis = lighting::directionOf({face, 0, 0});
    const glm::dvec3 side(axis.y, axis.z, axis.x), other(axis.z, axis.x, axis.y);
    const float tone = 0.1f + 0.1f * static_cast<float>(face);
    plates.push_back({position + 2.0 * axis + 0.5 * side + 0.7 * other, 0.9 * side, 0.6 * other, {tone, 0.9f, 0.1f}});
    plates.push_back({position + 1.8 * axis - 1.1 * side - 0.4 * other, 0.3 * side, 0.5 * other, {0.2f, tone, 0.8f}});
  }
  PreparedScene prepared;
  prepared.isLit = false;
  for (const Plate& plate : plates) addPlate(prepared.scene, plate);

  const std::vector<glm::vec4> cube = capture(prepared, glm::vec3(position));
  int shown = 0;
  for (int face = 0; face < lighting::kCubeFaces; ++face)
    for (int y = 0; y < kFilter.faceSize; ++y)
      for (int x = 0; x < kFilter.faceSize; ++x) {
        const Seen seen = trace(plates, position, lighting::texelDirection(face, x, y, kFilter.faceSize));
        if (seen.margin < 0.02) continue; // a rim
        const glm::vec4 texel = cube[lighting::texelIndex(face, x, y, kFilter.faceSize)];
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(texel[c], seen.color[c], 1e-3) << "face " << face << " x " << x << " y " << y;
        shown += seen.color != glm::vec3(0);
      }
  EXPECT_GT(shown, 6 * 100);
}

// Far below there is something, so that it is a scene.
PreparedScene makeSkyScene(const glm::vec3& skyLightColor) {
  PreparedScene prepared;
  addPlate(prepared.scene, {{0, -50, 0}, {1, 0, 0}, {0, 0, -1}, glm::vec3(0.5f)});
  scenes::Environment sky = scenes::makeSky();
  sky.rotationDeg = 70;
  for (std::size_t i = 0; i < sky.radiance.pixels.size(); ++i)
    sky.radiance.pixels[i] *= skyLightColor[static_cast<int>(i % 3)];
  prepared.panorama = std::move(sky);
  return prepared;
}

TEST_F(CaptureRender, IsTheEnvironmentWhereNothingElseIsSeen) {
  const PreparedScene prepared = makeSkyScene({0.5f, 1.f, 2.f});
  const std::vector<glm::vec4> expected = lighting::resampleEquirect(*prepared.panorama, kFilter.faceSize);
  const std::vector<glm::vec4> cube = capture(prepared, {1, 2, 3}, 4);
  for (int face = 0; face < lighting::kCubeFaces; ++face)
    for (int y = 0; y < kFilter.faceSize; ++y)
      for (int x = 0; x < kFilter.faceSize; ++x) {
        const std::size_t i = lighting::texelIndex(face, x, y, kFilter.faceSize);
        if (lighting::texelDirection(face, x, y, kFilter.faceSize).y < -0.97) continue;
        for (int c = 0; c < 3; ++c) ASSERT_FLOAT_EQ(cube[i][c], expected[i][c]) << face << " " << x << " " << y;
      }
}

// Glass before the sky: its own light over what it lets through.
TEST_F(CaptureRender, ShowsTheEnvironmentThroughWhatIsBlended) {
  PreparedScene prepared = makeSkyScene(glm::vec3(1));
  addPlate(prepared.scene, {{0, 0, -1}, {3, 0, 0}, {0, 3, 0}, glm::vec3(0.8f, 0.1f, 0.3f)});
  prepared.scene.materials.back().alphaMode = scenes::AlphaMode::blend;
  prepared.scene.materials.back().baseColor.a = 0.25f;
  const std::vector<glm::vec4> plain = capture(makeSkyScene(glm::vec3(1)), glm::vec3(0));
  const std::vector<glm::vec4> cube = capture(prepared, glm::vec3(0));
  const std::size_t i = lighting::texelIndex(5, 12, 9, kFilter.faceSize); // -Z
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(cube[i][c], 0.25f * prepared.scene.materials.back().baseColor[c] + 0.75f * plain[i][c], 2e-3);
}

} // namespace
} // namespace parity::job
