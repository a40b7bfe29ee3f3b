// One run on its way into the index: what changed since the run before, why, and what ends or begins with it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "history/index.h"

namespace parity::history {

struct Index::Adding {
  Index& index;
  const RunRecord& record;
  std::int64_t run = 0, previous = 0; // previous: that it is compared with
  Lane* before = nullptr;             // null: the first of its suite and branch
  Lane* now = nullptr;                // may be the same
  // The lane that `now` went on from: it knows scenes that no run of `now` has compared yet. Null: there is none.
  Lane* older = nullptr;
  std::unordered_set<std::int64_t> compared = {}, known = {}; // scenes: that were compared, that the run has
  std::unordered_set<std::int64_t> fromOlder = {};            // scenes that were compared with the older lane
  std::vector<std::int64_t> added = {};                       // subjects that are new

  void addScene(const SceneRecord& scene);
  // One event for a whole scene or view. Once all scenes are added.
  void addNewAndGone();
  void addCrashes();
  std::int64_t sceneIdOf(const SceneRecord& scene) const;

private:
  const Subject& subject(std::int64_t id) const;
  void event(std::int64_t about, const std::string& kind, const std::string& cause,
             const std::optional<std::int64_t>& metric = {}, double then = NAN, double here = NAN,
             std::size_t changed = 0);
  void insertState(std::int64_t id, Row& row, const std::string& verdict, const std::string& reason,
                   const std::string& rule, const PictureHashes& pictures);
  // lastSeen: the run that showed the subject last.
  void close(std::int64_t id, const Row& row, std::int64_t lastSeen);
  // Of a scene: that it could be compared, or why not.
  void addSceneState(std::int64_t id, const SceneRecord& scene, const std::string& cause);
  void addRow(std::int64_t id, std::int64_t sceneId, const RowRecord& row, const std::string& cause,
              std::int64_t lastSeen);
  void addInputs(std::int64_t sceneId, const report::SceneInputs& inputs);

  // The lane that its rows are compared with. Null: there is none.
  Lane* laneOf(std::int64_t sceneId) const;
  // Its own last run: while the scene has errors nothing of it is seen.
  std::int64_t lastSeenOf(std::int64_t sceneId) const;
  std::int64_t goneAfter(std::int64_t sceneId) const;
  const Makers& makers(std::int64_t sceneId) const;
  // What it was before in that lane; counted as seen.
  const Row* findOld(Lane* lane, std::int64_t id) const;
};

} // namespace parity::history
