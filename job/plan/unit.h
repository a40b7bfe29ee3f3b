// A unit of a plan: one scene with its views, as a worker leaves it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "job/scene/scene_comparison.h"

namespace parity::job {

// What differs from run to run: it is kept for run.json and never compared.
struct UnitRun {
  double seconds = 0, cpuSeconds = 0;
  std::string machine = {}; // its processor
  bool isCached = false;
  std::vector<std::pair<std::string, double>> timings = {}; // stage, ms
  std::vector<std::string> shaders = {};                    // that it was the first of its worker to compile
  bool isGivenUp = false; // no worker survived it: the scene is an error, until a worker does
};

// A picture or pixel file, whose content lies among the plan's blobs.
struct UnitFile {
  std::string file; // as the report names it
  std::string hash;
  std::uint64_t bytes = 0;
};

struct Unit {
  ComparedScene scene; // without pictures, and not judged
  std::vector<UnitFile> files;
  UnitRun run;
};

// What must be the same for a unit to be of a plan.
struct UnitOrigin {
  std::string plan, build, numerics; // digests of 32 digits
  std::uint64_t index = 0;           // the scene's place in the plan
};

// The origin, a hash of all that two workers must agree on, and the unit itself, with a checksum over everything. The
// machine's byte order: a unit is read by the build that wrote it.
std::vector<std::byte> toBytes(const Unit& unit, const UnitOrigin& origin);

// The hash of what is to be the same whoever does the unit.
struct ReadUnit {
  UnitOrigin origin;
  std::string content;
  std::optional<Unit> unit; // nothing where the build is another one
};
// Nothing where the bytes are no unit, or damaged. build: of the running program.
std::optional<ReadUnit> unitFromBytes(std::span<const std::byte> bytes, const std::string& build);

} // namespace parity::job
