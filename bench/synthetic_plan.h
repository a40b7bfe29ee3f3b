// A plan whose units are made up: what a merge has to read, without rendering.
#pragma once

#include <filesystem>

#include "bench/synthetic_report.h"

namespace parity::bench {

// Writes the plan and all its units. Each scene has so many pictures of some kB, content of their own. Throws Error.
void writeSyntheticUnits(const std::filesystem::path& folder, const ReportSize& size, int pictures);

// Merges them into the folder "merged" of the plan's.
void mergeSyntheticUnits(const std::filesystem::path& folder);

} // namespace parity::bench
