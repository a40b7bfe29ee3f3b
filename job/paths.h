// Which paths there are, and which of them a run shades.
#pragma once

#include <string>
#include <vector>

#include "job/settings.h"
#include "paths/path.h"

namespace parity::job {

// In the order in which they were added; the built-in ones first.
const std::vector<const paths::Path*>& allPaths();
// Adds a path to those that every run knows. Before the first use of knobs().
void addPath(const paths::Path& path);
// Throws Error (usage) naming the known ones.
const paths::Path& pathByName(const std::string& name);
std::vector<std::string> pathNames();

// What is shaded of a scene.
struct PathChoice {
  // The first is the one that the others are compared with.
  std::vector<const paths::Path*> chosen;
  bool truth = false;
  bool bakes = false; // the scene is to be baked: it keeps its panorama, which is not prefiltered
  // Place in the intermediates of the one path that is rendered (paths::Path::intermediates); 0: the lit colour.
  std::uint32_t intermediate = 0;

  bool compares() const { return chosen.size() > 1; }
};
// Of a report: the paths that the settings name, and the truth where they ask for it.
PathChoice pathsOf(const Settings& settings);

} // namespace parity::job
