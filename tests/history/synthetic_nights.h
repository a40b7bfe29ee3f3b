// Nights of a made-up suite, with changes whose cause is known: for the tests of history and its bench.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "history/run.h"

namespace parity::tests {

struct NightsOptions {
  std::size_t scenes = 8, views = 2, materials = 3; // materials a view; its whole image is one more row
  unsigned seed = 1;
};

// Of a row that has it.
double& figureOf(history::RowRecord& row, const std::string& name);

// A change that was planted: what `parity history blame` must find.
struct Planted {
  std::size_t night = 0;      // from 0: the first that shows it
  std::string subject;        // SCENE/VIEW/MATERIAL
  std::string cause;          // "asset", "build", ...; empty: none, so it is nondeterminism
  double before = 0, now = 0; // flip.mean
};

class Nights {
public:
  explicit Nights(const NightsOptions& options);

  // The next night, the day after: as the one before, but for what was planted since; times vary.
  history::RunRecord next();
  std::size_t count() const { return m_count; } // nights so far

  // Of a scene "asset", "environment", "request", "bake" or "pictures", of the run "build", "driver", "numerics" or
  // "settings"; or
  // "": figures change, and nothing else does. The figures of `rows` materials of the scene change. They show in the
  // next night.
  std::vector<Planted> plant(const std::string& cause, std::size_t scene, std::size_t rows = 1);

  history::RunRecord& state() { return m_record; } // of the next night

private:
  std::mt19937 m_random;
  history::RunRecord m_record;
  std::size_t m_count = 0, m_digests = 0;
};

} // namespace parity::tests
