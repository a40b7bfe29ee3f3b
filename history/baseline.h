// Which run a branch is held against (as Argos chooses it): the newest whole and complete run whose commit is an
// ancestor of the place where the branch began.
#pragma once

#include <optional>
#include <string>

#include "history/git.h"
#include "history/subject.h"

namespace parity::history {

struct BaselineRun {
  RunRef run;
  std::string report; // folder of its report, as it was when the run was added
};

struct BaselineQuestion {
  std::string into = "main", commit = "HEAD"; // names of commits: the branch that it goes into, and its own newest one
  std::optional<std::string> suite = {};      // none: any
};

// Goes through the merge base and its ancestors, the newest first; of several runs of a commit it takes the newest.
// Nothing: none of them has such a run. Throws Error (exit 4) where git knows no such commits, or no merge base.
std::optional<BaselineRun> findBaseline(const Database& index, const Git& git, const BaselineQuestion& question);

} // namespace parity::history
