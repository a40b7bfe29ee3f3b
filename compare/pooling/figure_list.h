// Lists of figures and metrics as people write them: the one reader of --metrics and of all that is like it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/pooling/statistic.h"

namespace parity::compare {

// Each part, separated by commas, is a figure ("flip.p95"), or a metric ("flip"), which stands for its first figure.
// Throws Error (usage) naming `subject` for an empty list or part, and for an unknown name, with the nearest known one.
std::vector<Statistic> parseFigures(std::string_view commaSeparated, const std::string& subject);

} // namespace parity::compare
