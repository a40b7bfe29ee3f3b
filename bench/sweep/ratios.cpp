#include "sweep/ratios.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::sweep {

namespace {

const std::vector<double>& timesOf(const VariantResult& v) {
  return v.stage == Stage::preparation ? v.prepareMs : v.times.deviceMs;
}

const SceneSweep* findScene(const SweepReport& report, const SceneSweep& like) {
  const auto found = std::ranges::find_if(report.scenes, [&](const SceneSweep& s) {
    return s.scene == like.scene && s.environment == like.environment && s.sun == like.sun;
  });
  return found == report.scenes.end() ? nullptr : &*found;
}

std::vector<std::string> machineNotes(const Machine& before, const Machine& now) {
  std::vector<std::string> notes;
  const auto compare = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) notes.push_back(fmt::format("another {}: {} then, {} now", what, a, b));
  };
  compare("processor", before.processor, now.processor);
  compare("number of threads", std::to_string(before.threads), std::to_string(now.threads));
  compare("device", before.device, now.device);
  compare("driver", before.driver, now.driver);
  compare("SIMD level", before.simd, now.simd);
  return notes;
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
    const SceneSweep* old = findScene(before, scene);
    if (old == nullptr) {
      ratios.notes.push_back(scene.scene + ": not in the earlier sweep");
      continue;
    }
    if (old->pixels != scene.pixels) {
      ratios.notes.push_back(
          fmt::format("{}: {} samples then, {} now; left out", scene.scene, old->pixels, scene.pixels));
      continue;
    }
    for (const VariantResult& v : scene.variants) {
      const VariantResult* then = findVariant(*old, v.id());
      if (v.stage == Stage::storage) continue; // no time is known of it
      if (then == nullptr)
        ratios.notes.push_back(fmt::format("{}, {}: not in the earlier sweep", scene.scene, v.id()));
      else if (timesOf(*then).size() < 2 || timesOf(v).size() < 2)
        ratios.notes.push_back(fmt::format("{}, {}: fewer than two rounds", scene.scene, v.id()));
      else
        pairs.push_back({&scene, then, &v});
    }
  }
  if (pairs.empty())
    throw base::Error(base::ExitCode::usage, "bench", "--compare",
                      "the two sweeps have no setting of any scene in common");
  ratios.confidence = 1 - 0.05 / static_cast<double>(pairs.size());
  for (const Pair& pair : pairs)
    ratios.variants.push_back({pair.scene->scene, pair.now->id(),
                               bootstrapRatio(timesOf(*pair.then), timesOf(*pair.now), ratios.confidence),
                               pair.then->whole.highend.flipMean, pair.now->whole.highend.flipMean});
  return ratios;
}

} // namespace parity::sweep
