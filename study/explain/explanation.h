// What `parity explain` finds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "scenes/scene.h"
#include "study/explain/sets.h"
#include "study/explain/switches.h"

namespace parity::explain {

// What a pixel of a material costs, specialised for it: scalar operations and texture fetches.
struct Cost {
  std::int64_t operations = 0, fetches = 0;
  Cost operator-(const Cost& other) const { return {operations - other.operations, fetches - other.fetches}; }
};

// A set of switches on one material.
struct SetOutcome {
  SwitchMask mask = 0;
  double flip = 0; // mean FLIP of the material
  Cost cost;
  // The same by the program that is specialised to the set; nothing where no sentence names the set.
  std::optional<double> rendered;
};

// A share of a material's pixels, by what the shader has there: roughness, metallic, N.V.
struct RangeShare {
  std::string quantity;         // "roughness", "metallic", "N.V"
  double from = 0, to = 1;      // of it
  double pixels = 0, error = 0; // shares of the material's pixels and of its FLIP, in [0, 1]
};

// A change of the asset itself: a factor of the material times `factor`.
struct AssetChange {
  std::string quantity;          // "roughness", "metallic", "base colour"
  double factor = 1;             // of its value in the file
  std::optional<double> value{}; // what it becomes, where no texture scales it and it is one number
  double flip = 0;               // mean FLIP of the material by both paths, rendered with this change alone
};

// Pictures of a material, as displayed.
struct Illustration {
  base::Image8 advised; // crop of the second path's picture with the advised set; empty: none
  std::string input;    // of the material's card, whose texture `mask` covers; empty: no texture
  base::Image8 mask;    // RGBA, one pixel for several texels: opaque where half of the FLIP lies
  double texels = 0;    // share of its seen pixels that are opaque
};

struct MaterialExplanation {
  std::string name;
  std::uint64_t pixels = 0;
  double limit = 0;         // of mean FLIP, above which the material is over budget (or warns)
  std::vector<double> flip; // of each set, by its mask
  // Of sets without switches that cheapen: the best of each size, from none; shapleyValues; changesSign.
  std::vector<SetOutcome> best;
  std::vector<double> worth;
  SwitchMask changing = 0;
  std::vector<SetOutcome> alone;    // each switch by itself
  SwitchMask repair = 0;            // the set that is advised, of `best`; 0: none
  std::vector<SetOutcome> cheaper;  // it with each switch that cheapens
  std::vector<RangeShare> ranges;   // of ten equal ranges of each quantity, those that hold pixels
  std::optional<AssetChange> asset; // the smallest that brings a material over its limit within it
  std::vector<std::string> advice;  // sentences
  Illustration illustration;        // where asked for
};

struct Skipped {
  std::string what, why;
};

struct SceneExplanation {
  std::string scene, environment, view;
  int width = 0, height = 0;
  std::vector<Switch> switches; // those that cheapen last
  std::vector<Skipped> skipped; // switches that were not tried
  std::vector<MaterialExplanation> materials;
  std::vector<std::string> tooSmall;       // materials of fewer pixels than their rule judges
  std::vector<scenes::SourceFile> sources; // what the scene was read from
  double seconds = 0;                      // of the sets: shading and measuring
  std::string failure;                     // empty: none
};

} // namespace parity::explain
