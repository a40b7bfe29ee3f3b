// The reference page of all knobs: docs/knobs.md.
#pragma once

#include <string>

namespace parity::job {

// Markdown: a table for each group of options, with the keys of suite files.
std::string describeKnobs();

} // namespace parity::job
