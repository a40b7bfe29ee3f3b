// A worker of a plan: a process that does one unit after another, as its supervisor tells it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "job/plan/plan.h"

namespace parity::job {

class Context;

// What a worker is at, in memory that its supervisor sees: it is true even of one that crashed.
class StagePage {
public:
  // Of the supervisor: a page of its own. Throws Error (exit 4).
  StagePage();
  // Of the worker: the one behind this descriptor; without effect where that is none.
  explicit StagePage(int descriptor);
  ~StagePage();
  StagePage(const StagePage&) = delete;
  StagePage& operator=(const StagePage&) = delete;

  int descriptor() const { return m_descriptor; }
  void set(const std::string& stage); // cut to kMostStage bytes
  std::string get() const;

  static constexpr std::size_t kMostStage = 240;

private:
  struct Page;
  int m_descriptor = -1;
  Page* m_page = nullptr;
};

// What a worker writes to its supervisor on the standard output that it was started with.
inline constexpr const char* kReadyLine = "ready";
std::string doneLine(std::size_t unit);

// Reads the numbers of units from standard input, a line each, and prints doneLine() once a unit is on the disk. First
// of all it prints kReadyLine. At the end of the input it ends. Returns the exit code: 0; 128 and a signal's number
// where it was told to stop. Throws Error: exit 78 where this machine rounds otherwise than that of the plan; exit 75
// where a unit cannot be written.
int runWorker(Context& context, const Plan& plan, const std::filesystem::path& folder, StagePage& page);

// Does these units, and prints their errors.
void doUnits(Context& context, const Plan& plan, const std::filesystem::path& folder,
             const std::vector<std::size_t>& units, const Progress& progress);

} // namespace parity::job
