#include "study/sweep/ratios.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "study/sweep/pareto.h"

namespace parity::sweep {

namespace {

const SceneSweep* findScene(const SweepReport& report, const SceneSweep& like) {
  const auto found = std::ranges::find_if(report.scenes, [&](const SceneSweep& s) {
    return s.scene == like.scene && s.environment == like.environment && s.sun == like.sun;
  });
  return found == report.scenes.end() ? nullptr : &*found;
}

std::vector<std::string> machineNotes(const Machine& before, const Machine& now) {
  std::vector<std::string> notes;
  const auto compare = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) notes.push_back(fmt::format("the {} differs: {} in the earlier sweep, {} now", what, a, b));
  };
  compare("processor", before.processor, now.processor);
  compare("number of threads", std::to_string(before.threads), std::to_string(now.threads));
  compare("device", before.device, now.device);
  compare("driver", before.driver, now.driver);
  compare("SIMD level", before.simd, now.simd);
  return notes;
}

std::map<std::string, std::string> knobsOf(const VariantResult& v) { return {v.knobs.begin(), v.knobs.end()}; }

// How likely it is by chance alone that one of two sets of so many times lies wholly below the other.
double chanceOfNoOverlap(std::size_t a, std::size_t b) {
  double ways = 1; // (a + b) over a
  for (std::size_t i = 1; i <= a; ++i) ways *= static_cast<double>(b + i) / static_cast<double>(i);
  return 2 / ways;
}

} // namespace

bool SweepRatios::anySlower() const {
  return std::ranges::any_of(variants, [](const VariantRatio& v) { return v.time.isSlower(); });
}

SweepRatios compareSweeps(const SweepReport& before, const SweepReport& now) {
  struct Pair {
    const SceneSweep* scene;
    const VariantResult *then, *now;
  };
  SweepRatios ratios;
  ratios.notes = machineNotes(before.machine, now.machine);
  std::vector<Pair> pairs;
  for (const SceneSweep& scene : now.scenes) {
    if (!scene.failure.empty()) {
      ratios.notes.push_back(scene.scene + ": could not be measured now");
      continue;
    }
    const SceneSweep* old = findScene(before, scene);
    if (old == nullptr) {
      ratios.notes.push_back(scene.scene + ": not in the earlier sweep");
      continue;
    }
    if (old->pixels != scene.pixels) {
      ratios.notes.push_back(fmt::format("{}: {} samples in the earlier sweep, {} now; not compared", scene.scene,
                                         old->pixels, scene.pixels));
      continue;
    }
    for (const VariantResult& v : scene.variants) {
      const VariantResult* then = findVariant(*old, v.id());
      if (v.stage == Stage::storage) continue; // no time is known of it
      if (then == nullptr)
        ratios.notes.push_back(fmt::format("{}, {}: not in the earlier sweep", scene.scene, v.id()));
      else if (knobsOf(*then) != knobsOf(v))
        ratios.notes.push_back(
            fmt::format("{}, {}: was another setting in the earlier sweep; not compared", scene.scene, v.id()));
      else
        pairs.push_back({&scene, then, &v});
    }
    for (const VariantResult& then : old->variants)
      if (findVariant(scene, then.id()) == nullptr)
        ratios.notes.push_back(fmt::format("{}, {}: only in the earlier sweep", scene.scene, then.id()));
  }
  for (const SceneSweep& scene : before.scenes)
    if (std::ranges::none_of(now.scenes, [&](const SceneSweep& s) { return s.scene == scene.scene; }))
      ratios.notes.push_back(scene.scene + ": only in the earlier sweep");
  if (pairs.empty())
    throw base::Error(base::ExitCode::usage, "bench", "--compare",
                      "the two sweeps have no setting and scene in common");
  ratios.confidence = 1 - 0.05 / static_cast<double>(pairs.size());
  const std::size_t few = std::erase_if(pairs, [&](const Pair& pair) {
    return chanceOfNoOverlap(timesOf(*pair.then).size(), timesOf(*pair.now).size()) > 1 - ratios.confidence;
  });
  if (few > 0) ratios.notes.push_back(fmt::format("{} settings are not judged, because they have too few rounds", few));
  const auto draws = static_cast<std::size_t>(std::clamp(20 / (1 - ratios.confidence), 1e4, 1e5)); // some in each tail
  for (const Pair& pair : pairs)
    ratios.variants.push_back({pair.scene->scene, pair.now->id(),
                               bootstrapRatio(timesOf(*pair.then), timesOf(*pair.now), ratios.confidence, draws),
                               pair.then->whole.first.flipMean, pair.now->whole.first.flipMean});
  return ratios;
}

} // namespace parity::sweep
