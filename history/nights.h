// The runs of a history, and what each of them brought.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "history/subject.h"

namespace parity::history {

struct Night {
  RunRef run;
  std::string suite, machine, version, build, device;
  bool isComplete = true, isWhole = true;
  bool isFirst = false; // there was no run that it could be compared with
  std::size_t rows = 0, failed = 0, warned = 0;
  std::map<std::string, std::size_t> events; // by kind
  // Of the scenes whose time is known: how many, how many of them came from the cache, and what the others took in
  // seconds; NaN: not known.
  std::size_t scenes = 0, cachedScenes = 0;
  double cpuS = 0, wallS = 0;
};

// The newest `most` runs (0: all) of the suite and branch, where one is given; oldest first.
std::vector<Night> nightsOf(const Database& index, const Where& where, std::size_t most);

// Kinds of events, the gravest first.
inline constexpr const char* kEventKinds[] = {"nondeterministic", "crashed", "regressed", "fixed",
                                              "changed",          "new",     "gone"};

struct Event {
  std::string subject; // its path
  std::string kind, cause, metric;
  double before = 0, now = 0; // of the metric
  std::size_t changed = 0;    // figures
};
// Of a run, in the order of its scenes. kind: empty: all.
std::vector<Event> eventsOf(const Database& index, std::int64_t run, const std::string& kind = {});

} // namespace parity::history
