#include "external/calibration_scene.h"

#include <cmath>

#include <fmt/format.h>

#include "external/angles.h"

namespace parity::external {

namespace {

constexpr float kBackdrop = -1.6f; // z: behind the ball

// Metres of the plane z = 0 that are half of the picture.
double halfExtent() { return kCameraDistance * std::tan(0.5 * kCameraFovDeg * kDegree); }

class Builder {
public:
  Builder() { m_scene.name = "calibration"; }

  std::uint32_t unlit(const glm::dvec3& color) {
    scenes::Material material;
    material.name = fmt::format("unlit {:.4g} {:.4g} {:.4g}", color.x, color.y, color.z);
    for (std::size_t i = 0; i < m_scene.materials.size(); ++i)
      if (m_scene.materials[i].name == material.name) return static_cast<std::uint32_t>(i);
    material.baseColor = glm::vec4(glm::vec3(color), 1);
    material.metallic = 0, material.unlit = true;
    m_scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(m_scene.materials.size() - 1);
  }

  // A polygon around a place of the picture, in the plane z = 0; corners counter-clockwise, in the picture's units.
  void polygon(const std::string& name, const glm::dvec2& at, const std::vector<glm::dvec2>& corners,
               const glm::dvec3& color) {
    scenes::Mesh mesh;
    mesh.name = name;
    for (const glm::dvec2& corner : corners) {
      mesh.positions.emplace_back(glm::vec3(glm::vec2((at + corner) * halfExtent()), 0));
      mesh.normals.emplace_back(0, 0, 1);
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.indices.insert(mesh.indices.end(), {0u, i - 1, i});
    mesh.material = unlit(color);
    add(std::move(mesh));
  }

  void backdrop() {
    constexpr float kHalf = 8;
    scenes::Mesh mesh;
    mesh.name = "backdrop";
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      mesh.positions.emplace_back(static_cast<float>(x) * kHalf, static_cast<float>(y) * kHalf, kBackdrop);
      mesh.normals.emplace_back(0, 0, 1);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material = unlit(glm::dvec3(0));
    add(std::move(mesh));
  }

  void ball() {
    constexpr std::uint32_t kAround = 256, kDown = 128;
    scenes::Mesh mesh;
    mesh.name = "mirror";
    for (std::uint32_t j = 0; j <= kDown; ++j)
      for (std::uint32_t i = 0; i <= kAround; ++i) {
        const double theta = kPi * j / kDown, phi = 2 * kPi * i / kAround;
        const glm::dvec3 normal(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        mesh.positions.emplace_back(normal * kBallRadius);
        mesh.normals.emplace_back(normal);
      }
    for (std::uint32_t j = 0; j < kDown; ++j)
      for (std::uint32_t i = 0; i < kAround; ++i) {
        const std::uint32_t a = j * (kAround + 1) + i, b = a + kAround + 1;
        if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1});
        if (j + 1 < kDown) mesh.indices.insert(mesh.indices.end(), {a, b + 1, b});
      }
    scenes::Material material;
    material.name = "mirror";
    material.metallic = 1, material.roughness = 0;
    mesh.material = static_cast<std::uint32_t>(m_scene.materials.size());
    m_scene.materials.push_back(std::move(material));
    add(std::move(mesh));
  }

  scenes::Scene take() { return std::move(m_scene); }

private:
  void add(scenes::Mesh mesh) {
    m_scene.instances.push_back({static_cast<std::uint32_t>(m_scene.meshes.size()), glm::mat4(1.f), mesh.name});
    m_scene.meshes.push_back(std::move(mesh));
  }
  scenes::Scene m_scene;
};

std::vector<glm::dvec2> rectangle(double halfWidth, double halfHeight, double angleDeg) {
  const double c = std::cos(angleDeg * kDegree), s = std::sin(angleDeg * kDegree);
  std::vector<glm::dvec2> corners;
  for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    corners.emplace_back(c * x * halfWidth - s * y * halfHeight, s * x * halfWidth + c * y * halfHeight);
  return corners;
}

} // namespace

const std::array<Mark, 8>& marks() {
  static const glm::dvec3 kWhite(1);
  static const std::array<Mark, 8> kMarks = {{{{-0.8, 0.8}, {1, 0, 0}},
                                              {{0, 0.8}, kWhite},
                                              {{0.8, 0.8}, {0, 1, 0}},
                                              {{0.8, 0}, kWhite},
                                              {{0.8, -0.8}, kWhite},
                                              {{0, -0.8}, kWhite},
                                              {{-0.8, -0.8}, {0, 0, 1}},
                                              {{-0.8, 0}, kWhite}}};
  return kMarks;
}

double rampLight(double part) { return std::pow(part, 2.2); }
double rampValue(std::size_t step) { return rampLight(static_cast<double>(step) / (kRampSteps - 1)); }

glm::dvec2 rampPlace(std::size_t step) {
  return {(static_cast<double>(step) - 0.5 * (kRampSteps - 1)) * 2 * kRampHalf, 0.615};
}

const std::array<Spot, 6>& spots() {
  static const std::array<Spot, 6> kSpots = {{{{1, 0, 0}, {1, 0, 0}},
                                              {{-1, 0, 0}, {0, 1, 1}},
                                              {{0, 1, 0}, {0, 1, 0}},
                                              {{0, -1, 0}, {1, 0, 1}},
                                              {{0, 0, 1}, {0, 0, 1}},
                                              {{0, 0, -1}, {1, 1, 0}}}};
  return kSpots;
}

scenes::Camera calibrationCamera() {
  scenes::Camera camera;
  camera.name = "calibration";
  camera.toWorld[3] = glm::vec4(0, 0, static_cast<float>(kCameraDistance), 1);
  camera.fovYDeg = static_cast<float>(kCameraFovDeg);
  camera.zNear = 1, camera.zFar = 30;
  return camera;
}

scenes::Scene calibrationScene() {
  Builder builder;
  builder.backdrop();
  builder.ball();
  constexpr int kCorners = 64;
  std::vector<glm::dvec2> circle;
  for (int i = 0; i < kCorners; ++i)
    circle.emplace_back(kMarkRadius * std::cos(2 * kPi * i / kCorners), kMarkRadius * std::sin(2 * kPi * i / kCorners));
  for (std::size_t i = 0; i < marks().size(); ++i)
    builder.polygon(fmt::format("mark {}", i + 1), marks()[i].at, circle, marks()[i].color);
  for (std::size_t i = 0; i < kRampSteps; ++i)
    builder.polygon(fmt::format("step {}", i + 1), rampPlace(i), rectangle(kRampHalf, kRampHalfHeight, 0),
                    glm::dvec3(rampValue(i)));
  builder.polygon("bar", {0, kBarAt}, rectangle(kBarHalf, kBarHalfHeight, kBarAngleDeg), glm::dvec3(1));
  scenes::Scene scene = builder.take();
  scene.cameras.push_back(calibrationCamera());
  scene.defaultCamera = 0;
  return scene;
}

scenes::Environment calibrationEnvironment() {
  constexpr int kHeight = 1024;
  scenes::Environment environment;
  environment.name = "calibration";
  environment.radiance = base::Image(2 * kHeight, kHeight, 3);
  const double least = std::cos(kSpotRadiusDeg * kDegree);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 2 * kHeight; ++x) {
      const double phi = (x + 0.5) / (2 * kHeight) * 2 * kPi - kPi, theta = (y + 0.5) / kHeight * kPi;
      const glm::dvec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      for (const Spot& spot : spots())
        if (glm::dot(direction, spot.direction) > least)
          for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(spot.color[c]);
    }
  return environment;
}

} // namespace parity::external
