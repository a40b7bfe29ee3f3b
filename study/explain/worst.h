// Where a scene is worst: the view, the sun and the rotation of the environment under which a material is farthest
// apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "job/scene_request.h"
#include "study/explain/search.h"

namespace parity::job {
class Context;
}

namespace parity::explain {

// Of the picture that confirms: fewer pixels of a material are slivers, which no view is chosen for.
inline constexpr std::uint64_t kLeastWorstPixels = 1000;

struct WorstOptions {
  int points = 0;    // pictures of views that are spread evenly, over all rotations; 0: as pointsFor gives
  int refined = 0;   // of them the best, of which each is refined; 0: eight, six of heavy scenes
  int steps = 40;    // by so many pictures at most
  int size = 128;    // longer side of the pictures that are searched, pixels
  int rotations = 4; // of the environment, evenly spread; 1: it stays as it is
};

// The number of points by which the search of most scenes takes less than a minute. triangles: over all instances.
int pointsFor(std::size_t triangles);

struct WorstView {
  std::string material;
  double flip = 0;     // mean FLIP of the material at the request's size
  double searched = 0; // of the worst material at the size that is searched
  std::uint64_t pixels = 0;
  glm::vec3 orbit{0};           // theta, phi (degrees), radius (metres), as scenes::ViewRequest has it
  std::optional<glm::vec2> sun; // azimuth, elevation (degrees) of --sun; none: the request has none
  float rotation = 0;           // of the environment, degrees
};

struct WorstResult {
  std::string scene;
  std::vector<WorstView> views; // confirmed, the worst first; at least one
  WorstView given;              // the request's own first view: its worst material, if that has pixels enough
  int pictures = 0;             // that were searched
};

// The first two paths of the settings are compared. Searched: orbits about the target of the request's first view from
// all around, 15 to 95 degrees off the zenith, at .5 to 1 of the distance that fits the scene; of --sun all azimuths
// and elevations from 5 to 85 degrees; rotations of the environment. A material counts where it would have
// kLeastWorstPixels at the request's size. What is found is rendered again at that size and ordered by it. Throws
// Error: notComparable where no view shows a chosen material large enough; usage for baked light, which no sun may
// turn, and for cameras of the file; as job::prepareScene does.
WorstResult findWorst(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                      const job::Progress& progress);

// The mean FLIP of views at random, in the same domain and at the search's size: the greatest of so many. For tests and
// benchmarks of the search.
double worstOfRandomViews(job::Context& context, const job::SceneRequest& request, const WorstOptions& options,
                          int views, unsigned seed);

// A scene of a suite file, with the view: to paste.
std::string toToml(const WorstView& view, const job::SceneRequest& request);

} // namespace parity::explain
