// Cameras and the sun: docs/design.md 8c's convention, term by term.
#include <cmath>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/view.h"

namespace parity::tests {
namespace {

using scenes::Camera;
using scenes::makeCamera;
using scenes::Scene;
using scenes::ViewRequest;

// A box from (-1,-2,-3) to (3,2,3): centre (1,0,0).
Scene makeBoxScene() {
  Scene scene;
  scene.name = "box";
  scenes::Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back({i & 1 ? 3 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -3});
    mesh.indices.push_back(static_cast<std::uint32_t>(i));
  }
  mesh.indices.push_back(0);
  mesh.normals.assign(8, {0, 1, 0});
  scene.meshes = {mesh};
  scene.instances = {{0, glm::mat4(1.f), "box"}};
  return scene;
}

glm::vec3 eyeOf(const Camera& camera) { return glm::vec3(camera.toWorld[3]); }

ViewRequest orbitOf(float theta, float phi, float radius) {
  ViewRequest request;
  request.orbit = glm::vec3(theta, phi, radius);
  return request;
}

TEST(View, OrbitPutsTheEyeWhereTheConventionSays) {
  const Scene scene = makeBoxScene();
  for (const float theta : {0.f, 30.f, 90.f, -120.f, 400.f})
    for (const float phi : {0.f, 20.f, 90.f, 180.f}) {
      const Camera camera = makeCamera(scene, orbitOf(theta, phi, 10), 1);
      const float t = glm::radians(theta), p = glm::radians(phi);
      const glm::vec3 expected =
          glm::vec3(1, 0, 0) + 10.f * glm::vec3(std::sin(p) * std::sin(t), std::cos(p), std::sin(p) * std::cos(t));
      EXPECT_NEAR(glm::length(eyeOf(camera) - expected), 0, 1e-4f) << theta << " " << phi;
      const glm::mat3 axes(camera.toWorld);
      EXPECT_NEAR(glm::determinant(axes), 1, 1e-5f);
      EXPECT_NEAR(glm::length(axes[2] - glm::normalize(expected - glm::vec3(1, 0, 0))), 0, 1e-5f) << "looks along -Z";
      if (phi > 0 && phi < 180) {
        EXPECT_GT(axes[1].y, 0) << "+Y is up";
      }
      EXPECT_NEAR(axes[0].y, 0, 1e-6f) << "no roll";
    }
}

TEST(View, TargetMovesTheOrbit) {
  ViewRequest request = orbitOf(0, 90, 5);
  request.target = glm::vec3(1, 2, 3);
  EXPECT_NEAR(glm::length(eyeOf(makeCamera(makeBoxScene(), request, 1)) - glm::vec3(1, 2, 8)), 0, 1e-5f);
}

TEST(View, AutomaticCameraFitsTheBoundsClosely) {
  const Scene scene = makeBoxScene();
  for (const float aspect : {0.5f, 1.f, 2.f}) {
    const Camera camera = makeCamera(scene, {}, aspect);
    EXPECT_EQ(camera.fovYDeg, 45.f);
    const glm::mat4 toView = glm::inverse(camera.toWorld);
    const float tanY = std::tan(glm::radians(22.5f));
    float fill = 0;
    for (const glm::vec3& p : scene.meshes[0].positions) {
      const glm::vec3 v = glm::vec3(toView * glm::vec4(p, 1));
      EXPECT_GT(-v.z, camera.zNear);
      EXPECT_LT(-v.z, camera.zFar);
      fill = std::max({fill, std::abs(v.y) / (-v.z * tanY), std::abs(v.x) / (-v.z * tanY * aspect)});
    }
    EXPECT_LE(fill, 1.f) << "all of it in the picture";
    EXPECT_GT(fill, 0.9f) << "and no larger than needed";
  }
}

TEST(View, FitsSceneOfMillimetresAndOfKilometres) {
  for (const float scale : {1e-3f, 1e4f}) {
    Scene scene = makeBoxScene();
    scene.instances[0].toWorld = glm::mat4(glm::mat3(scale));
    const Camera camera = makeCamera(scene, {}, 1);
    EXPECT_GT(camera.zNear, 0);
    EXPECT_LT(camera.zFar / camera.zNear, 20) << "a tight depth range";
  }
}

TEST(View, CameraWithinTheBoundsKeepsAPositiveNearPlane) {
  const Camera camera = makeCamera(makeBoxScene(), orbitOf(0, 90, 0.01f), 1);
  EXPECT_GT(camera.zNear, 0);
  EXPECT_GT(camera.zFar, camera.zNear);
}

TEST(View, FindsCamerasByNameThenByIndexAndNamesTheKnownOnes) {
  Scene scene = makeBoxScene();
  scene.cameras.resize(2);
  scene.cameras[0].name = "1"; // a name before an index
  scene.cameras[0].fovYDeg = 10;
  scene.cameras[1].name = "front";
  scene.cameras[1].zFar = 0;
  scene.cameras[1].toWorld[3] = glm::vec4(0, 0, 9, 1);
  ViewRequest request;
  request.camera = "1";
  EXPECT_EQ(makeCamera(scene, request, 1).fovYDeg, 10.f);
  request.camera = "front";
  const Camera front = makeCamera(scene, request, 1);
  EXPECT_GT(front.zFar, 12.f) << "an infinite far plane becomes one beyond the bounds";
  EXPECT_EQ(front.zNear, scene.cameras[1].zNear) << "the file's own";
  request.camera = "0";
  EXPECT_EQ(makeCamera(scene, request, 1).name, "1");
  request.camera = "side";
  expectError([&] { makeCamera(scene, request, 1); }, {"--camera", "'side'", "auto, '1' (0), 'front' (1)"},
              base::ExitCode::usage);
  request.camera = "auto";
  EXPECT_EQ(makeCamera(scene, request, 1).fovYDeg, 45.f) << "no default camera: fitted";
  scene.defaultCamera = 0;
  EXPECT_EQ(makeCamera(scene, request, 1).fovYDeg, 10.f);
  EXPECT_GT(makeCamera(scene, request, 0.5f).fovYDeg, 10.f) << "narrow images show the whole width";
}

TEST(View, RefusesWhatMakesNoSense) {
  const Scene scene = makeBoxScene();
  const auto usage = base::ExitCode::usage;
  expectError([&] { makeCamera(scene, orbitOf(0, 181, 1), 1); }, {"--orbit"}, usage);
  expectError([&] { makeCamera(scene, orbitOf(0, 90, -1), 1); }, {"--orbit"}, usage);
  expectError([&] { makeCamera(scene, orbitOf(NAN, 90, 1), 1); }, {"--orbit"}, usage);
  ViewRequest request;
  request.fovYDeg = 0;
  expectError([&] { makeCamera(scene, request, 1); }, {"--fov"}, usage);
  request = orbitOf(0, 90, 1);
  request.camera = "front";
  expectError([&] { makeCamera(scene, request, 1); }, {"--camera", "--orbit"}, usage);
  expectError([&] { makeCamera(scene, {}, 0); }, {"--size"}, usage);
  Scene empty;
  empty.name = "nothing";
  expectError([&] { makeCamera(empty, {}, 1); }, {"nothing", "empty"});
}

TEST(Sun, ShinesFromItsAzimuthAndElevation) {
  for (const float azimuth : {0.f, 90.f, 200.f})
    for (const float elevation : {0.f, 50.f, 90.f, -10.f}) {
      const scenes::Light sun = scenes::makeSun({azimuth, elevation, 4});
      const float a = glm::radians(azimuth), e = glm::radians(elevation);
      const glm::vec3 towards(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
      EXPECT_EQ(sun.kind, scenes::LightKind::directional);
      EXPECT_EQ(sun.color, glm::vec3(4));
      EXPECT_NEAR(glm::length(sun.direction + towards), 0, 1e-6f) << "light travels away from the sun";
    }
  expectError([] { scenes::makeSun({0, 91, 1}); }, {"--sun"}, base::ExitCode::usage);
  expectError([] { scenes::makeSun({0, 45, -1}); }, {"--sun"}, base::ExitCode::usage);
  expectError([] { scenes::makeSun({NAN, 45, 1}); }, {"--sun"}, base::ExitCode::usage);
}

} // namespace
} // namespace parity::tests
