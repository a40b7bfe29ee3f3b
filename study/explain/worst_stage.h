// A scene under one rotation of the environment, at one size of picture, seen from anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "job/scene/scene_on_device.h"
#include "job/scene_request.h"

namespace parity::explain {

// The material that is farthest apart in a view.
struct Outcome {
  std::string material;
  double flip = 0; // mean; 0: none is large enough
  std::uint64_t pixels = 0;
};

class Stage {
public:
  // size: the longer side of the pictures, whose environment is filtered coarsely; 0: as the request has both.
  // rotation: degrees beyond the request's. Throws as job::prepareScene does.
  Stage(job::Context& context, job::SceneRequest request, int size, float rotation);

  std::size_t triangles() const; // over all instances
  bool hasSun() const { return m_request.settings.scene.sun.has_value(); }
  float radius() const { return m_radius; } // of the orbit that fits the scene

  // least: pixels below which a material does not count.
  Outcome look(const glm::vec3& orbit, const std::optional<glm::vec2>& sun, std::uint64_t least);
  Outcome look(const scenes::ViewRequest& view, const std::optional<glm::vec2>& sun, std::uint64_t least);

private:
  float aspect() const;
  bool isChosen(const std::string& material) const;
  void turnSun(const glm::vec2& sun);

  job::Context& m_context;
  job::SceneRequest m_request;
  job::PathChoice m_paths;
  job::PreparedScene m_prepared;
  std::unique_ptr<job::SceneOnDevice> m_scene;
  float m_radius = 1;
};

} // namespace parity::explain
