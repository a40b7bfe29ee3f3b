// Where each object of a scene lies in the pages of its lightmap.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace parity::scenes {

// Every corner of every triangle has a uv of its own, so that charts may end at any edge without splitting vertices.
// Instances of one mesh may share corners: each adds an offset.
struct LightmapUvs {
  struct Place {
    std::uint32_t firstCorner = 0; // into corners: one an index of the instance's mesh, in the order of the indices
    glm::vec2 offset{0.f};         // added to them
    std::int32_t page = -1;        // -1: the object has no lightmap
    std::uint32_t capture = 0;     // the environment capture nearest to it
  };
  std::vector<glm::vec2> corners; // with the offset: [0, 1]^2 of a page, v down
  std::vector<Place> places;      // one an instance
};

} // namespace parity::scenes
