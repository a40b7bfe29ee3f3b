// What the index knows of a subject over the runs: its name, the lanes that follow one another, what it was in each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "history/database.h"

namespace parity::history {

// A material of a view, a whole image (ordinal kWhole) or a scene (kScene, of history/index.h).
struct SubjectRef {
  std::int64_t id = 0, sceneId = 0;
  std::string suite, scene, view, material;
  int ordinal = 0;          // of a material: its number among namesakes of the view, from 0
  std::string path() const; // "SCENE/VIEW/MATERIAL", "SCENE/VIEW" or "SCENE"; the second of a name: "MATERIAL (2)"
};

struct RunRef {
  std::int64_t id = 0;
  std::string name, started, branch, commit, verdict;
};

// Which runs are asked about. Empty: those of the newest run.
struct Where {
  std::optional<std::string> suite, branch;
};

// With what is empty filled in: the suite of the newest run, the branch of that suite's newest run.
Where settled(const Database& index, const Where& where);

// By its path. Throws Error (usage) with the nearest names where there is none.
SubjectRef findSubject(const Database& index, const std::string& path, const Where& where);

RunRef findRun(const Database& index, std::int64_t id);

// A lane, and its last run that counts: what came later is in the lane that stands before it.
struct LaneSpan {
  std::int64_t lane = 0, lastRun = 0;
};
// The lane of that run, up to it, then the one that the lane went on from, and so on.
std::vector<LaneSpan> lanesUpTo(const Database& index, std::int64_t run);
// The same for the newest whole run of this suite and branch. Empty: there is none.
std::vector<LaneSpan> lanesOf(const Database& index, const std::string& suite,
                              const std::optional<std::string>& branch);

// A value or a verdict from its first run to its last one, over all lanes.
struct Interval {
  std::int64_t firstRun = 0, lastRun = 0; // the last one that showed it
  bool isNow = false;                     // the newest run of the lane still has it
  double value = 0;
  std::string verdict, reason, rule;
};
// Oldest first; neighbours differ, or something was missing between them.
std::vector<Interval> statesOf(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t subject);

struct Course {
  std::int64_t metric = 0; // its id in the index
  std::string name;
  std::vector<Interval> values; // as the intervals of statesOf
};
// All figures that the subject has in any of these lanes, in the order in which the index got to know them.
std::vector<Course> coursesOf(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t subject);

} // namespace parity::history
