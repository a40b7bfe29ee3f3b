// The stages that a path's picture passes through: what each alone makes of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/pooling/figures.h"

namespace parity::report {

inline constexpr const char *kEncodingStage = "encoding", // storing the colour in the render target
    *kTexturesStage = "textures";                         // compressing the textures

// Of a material or a whole image. The reference is the path's picture without the stage, the test is that with it, both
// as displayed; of every other stage after the target too.
struct StageResult {
  std::string stage;        // kEncodingStage, kTexturesStage, ...: once in a list
  std::string through;      // what the picture passes through there: "rgba8-gamma2", "astc6x6"
  compare::Figures figures; // flip.mean, flip.p95, flip.max, bias.*
};

// Null where the list has no such stage.
const StageResult* findStage(const std::vector<StageResult>& stages, std::string_view stage);

// Whether a table shows the stage's column: the encoding where anything of it would show, a mean FLIP of at least
// 0.0005 or one that is not known; any other always, as the run asked for it.
bool isShown(const StageResult& stage);

// Its column in a table, and what the figures in it are: "mean FLIP that storing mobile's colour in rgba8-gamma2 makes
// by itself". path: by its name.
struct StageWords {
  std::string column, figures;
};
StageWords describe(const StageResult& stage, const std::string& path);

} // namespace parity::report
