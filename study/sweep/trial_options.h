// What of a scene is swept, and how often.
#pragma once

#include <string>
#include <vector>

namespace parity::sweep {

struct TrialOptions {
  int rounds = 9;                    // that are timed, after one that warms up
  int preparationRounds = 3;         // of what is prepared once
  bool truth = true;                 // also shade the truth, for errors against it
  std::vector<std::string> settings; // globs over ids ("mobile: refit*"); empty: all. Both defaults are always there
};

} // namespace parity::sweep
