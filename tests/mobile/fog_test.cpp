// Fog in both paths: at the pixel in high-end, at the vertices in mobile or where asked for at the pixel, over every
// term and every kind of surface.
#include "support/path_quad.h"

#include "highend/renderer.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::ShadedPoint;
namespace f64 = shading::f64;

constexpr std::uint32_t kFogSide = 24;
constexpr float kHalf = 50, kEyeX = 10, kEyeY = 5, kDistance = 12, kHalfHeight = 30;
constexpr scenes::Fog kFog{
    .density = 0.02f, .heightFalloff = 0.03f, .height = 2, .color = {0.5f, 0.7f, 2}, .startDistance = 3};

// A wall of 100 m in the plane z = 0, cells x cells quads, that only glows.
scenes::Scene makeWall(int cells) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials[0].emissive = {1, 2, 3};
  scene.materials[0].baseColor = {0, 0, 0, 1};
  scenes::Mesh& mesh = scene.meshes[0];
  mesh.positions.clear();
  mesh.indices.clear();
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x)
      mesh.positions.emplace_back(kHalf * (2.f * x / cells - 1), kHalf * (2.f * y / cells - 1), 0);
  const auto row = static_cast<std::uint32_t>(cells) + 1;
  for (std::uint32_t y = 0; y + 1 < row; ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x, b = a + 1, c = b + row, d = a + row;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  mesh.tangents.clear();
  mesh.uv0.clear();
  scene.fog = kFog;
  return scene;
}

scenes::Camera makeCamera(bool orthographic = false) {
  scenes::Camera camera = tests::makeFrontCamera(kHalfHeight, kDistance, orthographic);
  camera.toWorld = tests::translation(kEyeX, kEyeY, kDistance);
  return camera;
}

// Of the wall, from the eye: the integral has a test of its own.
double transmittanceAt(const glm::dvec3& place) {
  const glm::dvec3 eye(kEyeX, kEyeY, kDistance);
  return f64::heightFogTransmittance(
      {kFog.density, kFog.heightFalloff, kFog.height, kFog.startDistance, kFog.maxOpacity}, eye.y, place.y - eye.y,
      glm::length(place - eye));
}

struct SeenPoint {
  glm::dvec2 place; // in the wall's plane
  ShadedPoint shaded;
};

class FogTest : public tests::DeviceTest {
protected:
  template <typename MakeRenderer> std::vector<SeenPoint>
  shadeAll(const scenes::Scene& scene, const scenes::Camera& camera, const MakeRenderer& makeRenderer) {
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kFogSide, kFogSide);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, kFogSide}, glm::vec2(0.5f));
    const gpu::Surface& surface = layers.front();
    EXPECT_EQ(surface.size(), std::size_t{kFogSide} * kFogSide);
    const gpu::ShadedSurface shaded = makeRenderer(buffers, pass.binKinds()).shade(surface, camera);
    std::vector<SeenPoint> points(surface.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t x = surface.pixels[i] % kFogSide, y = surface.pixels[i] / kFogSide;
      points[i].place = {kEyeX + kHalfHeight * ((x + 0.5) * 2 / kFogSide - 1),
                         kEyeY - kHalfHeight * ((y + 0.5) * 2 / kFogSide - 1)};
      points[i].shaded.color = glm::vec3(shaded.color[i]);
      for (std::size_t t = 0; t < shaded.terms.size(); ++t) points[i].shaded.terms[t] = glm::vec3(shaded.terms[t][i]);
    }
    return points;
  }
  std::vector<SeenPoint> shadeHighend(const scenes::Scene& scene, const scenes::Camera& camera) {
    return shadeAll(scene, camera, [&](const auto& buffers, const auto& kinds) {
      return highend::Renderer(
          device(), buffers, kinds, {.terms = true},
          {.model = {.diffuse = highend::DiffuseLobe::lambert}, .compensation = highend::Compensation::none});
    });
  }
  std::vector<SeenPoint> shadeMobile(const scenes::Scene& scene, const scenes::Camera& camera,
                                     const Options& options = tests::inFp32("ue4-2020"), bool wide = false) {
    return shadeAll(scene, camera, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, {.terms = true, .wide = wide}, options);
    });
  }
  static Options atPixels(Precision precision = Precision::fp32) {
    Options options = tests::inFp32("ue4-2020");
    options.precision = precision;
    options.pixelFog = true;
    return options;
  }
  static void expectFog(const SeenPoint& point, double transmittance) {
    const glm::vec3 glow(1, 2, 3);
    const auto t = static_cast<float>(transmittance);
    tests::expectNear(point.shaded[Term::emissive], glow * t, 2e-5f, "emissive");
    tests::expectNear(point.shaded[Term::fog], kFog.color * (1 - t), 2e-5f, "fog");
    tests::expectNear(point.shaded.color, glow * t + kFog.color * (1 - t), 2e-5f, "colour");
  }
};

TEST_F(FogTest, HighendEvaluatesItAtThePixel) {
  for (const SeenPoint& point : shadeHighend(makeWall(1), makeCamera()))
    expectFog(point, transmittanceAt({point.place, 0}));
}

// Two triangles, (-,-) (+,-) (+,+) and (-,-) (+,+) (-,+): what the vertices have, linear over the plane between them.
TEST_F(FogTest, MobileInterpolatesThatOfTheVertices) {
  const auto atCorner = [](double x, double y) { return transmittanceAt({x * kHalf, y * kHalf, 0}); };
  const double a = atCorner(-1, -1), b = atCorner(1, -1), c = atCorner(1, 1), d = atCorner(-1, 1);
  double largest = 0;
  for (const SeenPoint& point : shadeMobile(makeWall(1), makeCamera())) {
    const glm::dvec2 s = (point.place / static_cast<double>(kHalf) + 1.0) / 2.0;
    const double expected = s.y < s.x ? a + (b - a) * s.x + (c - b) * s.y : a + (c - d) * s.x + (d - a) * s.y;
    expectFog(point, expected);
    largest = std::max(largest, std::abs(expected - transmittanceAt({point.place, 0})));
  }
  EXPECT_GT(largest, 0.3) << "a coarse mesh shows it coarsely";
}

TEST_F(FogTest, MobileEvaluatesItAtThePixelWhereAskedFor) {
  for (const bool wide : {false, true}) {
    for (const SeenPoint& point : shadeMobile(makeWall(1), makeCamera(), atPixels(), wide))
      expectFog(point, transmittanceAt({point.place, 0}));
    if (!device().report().float16) continue;
    for (const SeenPoint& point : shadeMobile(makeWall(1), makeCamera(), atPixels(Precision::fp16), wide)) {
      const double t = transmittanceAt({point.place, 0});
      EXPECT_NEAR(point.shaded[Term::fog].x, kFog.color.x * (1 - t), 1e-3);
      EXPECT_NEAR(point.shaded[Term::emissive].x, t, 1e-3);
    }
  }
}

TEST_F(FogTest, OfAFineMeshThatOfThePixelsIsThatOfTheVertices) {
  const std::vector<SeenPoint> vertices = shadeMobile(makeWall(64), makeCamera()),
                               pixels = shadeMobile(makeWall(64), makeCamera(), atPixels());
  double largest = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double difference = std::abs(pixels[i].shaded[Term::fog].x - vertices[i].shaded[Term::fog].x);
    EXPECT_LT(difference, 2.5e-3);
    largest = std::max(largest, difference);
  }
  EXPECT_GT(largest, 0) << "they are not the same to the last bit";
}

TEST_F(FogTest, AFineMeshShowsTheSameInBothPaths) {
  for (const SeenPoint& point : shadeMobile(makeWall(64), makeCamera()))
    EXPECT_NEAR(point.shaded[Term::fog].x, kFog.color.x * (1 - transmittanceAt({point.place, 0})), 2e-3);
}

TEST_F(FogTest, OfAnOrthographicCameraBeginsAtItsPlane) {
  const double expected = f64::heightFogTransmittance({kFog.density, 0, 0, kFog.startDistance, 1}, 0, 0, kDistance);
  scenes::Scene scene = makeWall(1);
  scene.fog->heightFalloff = 0;
  for (const auto& points : {shadeHighend(scene, makeCamera(true)), shadeMobile(scene, makeCamera(true)),
                             shadeMobile(scene, makeCamera(true), atPixels())})
    for (const SeenPoint& point : points) expectFog(point, expected);
}

TEST_F(FogTest, UnlitSurfacesHaveItToo) {
  scenes::Scene scene = makeWall(64);
  scene.materials[0].unlit = true;
  scene.materials[0].baseColor = {1, 2, 3, 1};
  for (const SeenPoint& point : shadeHighend(scene, makeCamera())) expectFog(point, transmittanceAt({point.place, 0}));
  for (const SeenPoint& point : shadeMobile(scene, makeCamera(), atPixels()))
    expectFog(point, transmittanceAt({point.place, 0}));
  const std::vector<SeenPoint> points = shadeMobile(scene, makeCamera());
  EXPECT_GT(points[0].shaded[Term::fog].x, 0.1f);
  tests::expectNear(points[0].shaded[Term::emissive],
                    glm::vec3(1, 2, 3) * (1 - points[0].shaded[Term::fog].x / kFog.color.x), 1e-5f, "unlit");
}

// All that is lit and glows, with and without: each term but the fog's keeps the same share.
TEST_F(FogTest, TakesTheSameShareOfEveryTerm) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  scenes::Light lamp;
  lamp.position = {0.3f, 0, 1};
  scenes::Scene scene = tests::makeLeaningQuad(0.3f);
  scene.materials[0].metallic = 0.5f;
  scene.materials[0].emissive = {1, 2, 3};
  scenes::Scene foggy = scene;
  foggy.fog = scenes::Fog{.density = 0.2f, .color = {0.5f, 0.7f, 2}};
  const auto check = [&](const auto& makeRenderer) {
    const ShadedPoint without = tests::shadeQuad(device(), scene, makeRenderer),
                      with = tests::shadeQuad(device(), foggy, makeRenderer);
    const float t = std::exp(-0.2f * 3);
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < shading::kBaseTermCount; ++k) {
      const auto term = static_cast<Term>(k);
      sum += with[term];
      if (term == Term::fog || term == Term::lightmap) continue;
      EXPECT_GT(without[term].x, 0) << shading::kTermNames[k];
      tests::expectNear(with[term], without[term] * t, 1e-5f, "term");
    }
    tests::expectNear(with[Term::fog], glm::vec3(0.5f, 0.7f, 2) * (1 - t), 1e-5f, "fog");
    EXPECT_EQ(without[Term::fog], glm::vec3(0));
    tests::expectNear(with.color, sum, 1e-6f, "colour");
  };
  const std::vector<scenes::Light> lights = {tests::makeDirectional({0.2f, 0.3f, 1}, glm::vec3(2)), lamp};
  const base::Image lut =
      highend::makeEnvBrdfLut(highend::GeometryTerm::heightCorrelated, highend::FresnelCurve::schlick, 32);
  check([&](const auto& buffers, const auto& kinds) {
    return Renderer(device(), buffers, kinds, {.environment = &environment, .lights = lights, .terms = true},
                    tests::inFp32("ue4-2020"));
  });
  check([&](const auto& buffers, const auto& kinds) {
    return highend::Renderer(device(), buffers, kinds,
                             {.environment = &environment, .lut = &lut, .lights = lights, .terms = true}, {});
  });
}

TEST_F(FogTest, ASceneWithoutFogHasNoBufferOfIt) {
  scenes::Scene scene = makeWall(1);
  const auto bytesOfFog = [&] {
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kFogSide, kFogSide);
    return pass.render(makeCamera(), {0, kFogSide}, glm::vec2(0.5f)).front().fog.size();
  };
  EXPECT_EQ(bytesOfFog(), kFogSide * kFogSide * sizeof(glm::vec4));
  scene.fog.reset();
  EXPECT_EQ(bytesOfFog(), sizeof(glm::vec4));
}

} // namespace
} // namespace parity::mobile
