// Totals by cause: how many materials failed or warned because of what, and where each is worst.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/report.h"

namespace parity::report {

inline constexpr const char* kCauseNotMeasured = "cause not measured";

// The term that makes the material differ; nothing: none does alone, or none is known.
std::optional<compare::TermEffect> causeOf(const MaterialResult& material);

// Why there is no such term, in words: "NaN or infinite pixels", kNoSingleTerm, kCauseNotMeasured.
std::string describeNoCause(const MaterialResult& material);

struct CauseTotal {
  std::string words;                  // "skySpecular (reflections of the environment)"
  std::size_t materials = 0;          // of scenes: one that several views show counts once
  const SceneResult* scene = nullptr; // where its mean FLIP is largest
  const ViewResult* view = nullptr;
  const MaterialResult* worst = nullptr;
};

// Of the materials with a verdict of at least warn, the most frequent first, what was not measured last. They point
// into the report.
std::vector<CauseTotal> totalsByCause(const Report& report);

} // namespace parity::report
