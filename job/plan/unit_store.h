// The folder of a plan: its units and the content of their pictures. Any number of machines may write to it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "job/plan/plan.h"
#include "job/plan/unit.h"

namespace parity::job {

class UnitStore {
public:
  UnitStore(std::filesystem::path folder, const Plan& plan);

  // Whether there is a file of it.
  bool has(std::size_t index) const;
  // Why there is no use in a unit; empty: it is there, whole, with all its pictures.
  std::string findFault(std::size_t index) const;
  // Those with a fault, in order, but those last that workers began most often: a scene that ends the whole machine
  // must not keep the others from being done. Of the shard alone if one is given.
  std::vector<std::size_t> missing() const;
  std::vector<std::size_t> missing(std::size_t shard) const;

  // Keeps a scene: first its pictures, then the unit, which is on the disk when this returns. Where a whole unit of
  // this plan is there, that stays, unless it was given up; one of other content is put beside it, for differs().
  // Throws Error (exit 4).
  void put(std::size_t index, ComparedScene scene, UnitRun run) const;
  // Throws Error: exit 78 for a unit of another plan, build or machine; exit 4 for one that is missing or damaged.
  Unit read(std::size_t index) const;
  // Whether a second worker found other figures.
  bool differs(std::size_t index) const;

  // Removes the units that are errors, and those whose scene was read from files that have changed since: for a plan
  // that is made again.
  void dropOutdated() const;

  // A worker has begun the unit, and has done it. Without effect where nothing can be written.
  void noteBegun(std::size_t index) const;
  void forgetBegun(std::size_t index) const;
  bool wasBegun(std::size_t index) const;
  // A worker that did not finish the unit: what happened, for people. It stays when another try succeeds.
  void noteCrash(std::size_t index, const std::string& words) const;
  std::string crashOf(std::size_t index) const; // empty: none

  // Puts a unit's file below the folder under its name in the report: by a link where the file system can.
  void place(const UnitFile& file, const std::filesystem::path& folder) const;
  std::vector<std::byte> contentOf(const UnitFile& file) const;

private:
  std::filesystem::path fileOf(std::size_t index, const char* ending) const;
  std::filesystem::path blobOf(const std::string& hash) const;
  UnitFile keep(const EncodedPicture& picture) const;
  std::uintmax_t timesBegun(std::size_t index) const;
  void sortByBegun(std::vector<std::size_t>& units) const;
  // Throws Error as read does.
  ReadUnit readWhole(const std::filesystem::path& file) const;

  std::filesystem::path m_folder;
  const Plan& m_plan;
};

} // namespace parity::job
