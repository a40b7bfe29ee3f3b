#include "study/explain/team.h"

#include <algorithm>
#include <bit>
#include <map>

namespace parity::explain {

namespace {

// A scene's mask for a set of ids.
SwitchMask maskIn(const SceneExplanation& scene, const std::vector<std::string>& ids) {
  SwitchMask mask = 0;
  for (std::size_t i = 0; i < scene.switches.size(); ++i)
    if (std::ranges::count(ids, scene.switches[i].id()) > 0) mask |= SwitchMask{1} << i;
  return mask;
}

std::vector<std::string> mostWorth(const std::vector<SceneExplanation>& scenes) {
  std::map<std::string, double> worth;
  std::vector<std::string> ids; // in the order of their first scene
  for (const SceneExplanation& scene : scenes)
    for (std::size_t i = 0; i < scene.switches.size(); ++i) {
      if (scene.switches[i].cheapens) continue;
      const std::string id = scene.switches[i].id();
      if (worth.try_emplace(id, 0).second) ids.push_back(id);
      for (const MaterialExplanation& material : scene.materials) worth[id] += material.worth[i];
    }
  std::vector<std::string> best = ids;
  std::ranges::stable_sort(best, std::greater(), [&](const std::string& id) { return worth[id]; });
  best.resize(std::min(best.size(), kMaxSwitches));
  std::erase_if(ids, [&](const std::string& id) { return std::ranges::count(best, id) == 0; });
  return ids;
}

TeamSet tryOn(const std::vector<SceneExplanation>& scenes, std::vector<std::string> ids, std::size_t materials) {
  TeamSet set{.switches = std::move(ids), .within = 0, .meanFlip = 0, .operations = 0};
  for (const SceneExplanation& scene : scenes) {
    const SwitchMask mask = maskIn(scene, set.switches);
    for (const MaterialExplanation& material : scene.materials) {
      set.within += material.flip[mask] <= material.limit;
      set.meanFlip += material.flip[mask];
      for (const SetOutcome& alone : material.alone)
        if ((alone.mask & mask) != 0)
          set.operations += static_cast<double>((alone.cost - material.best.front().cost).operations);
    }
  }
  set.meanFlip /= static_cast<double>(materials);
  set.operations /= static_cast<double>(materials);
  return set;
}

bool isBetter(const TeamSet& a, const TeamSet& b) {
  if (a.within != b.within) return a.within > b.within;
  if (a.operations != b.operations) return a.operations < b.operations;
  return a.meanFlip < b.meanFlip;
}

} // namespace

TeamView teamViewOf(const std::vector<SceneExplanation>& all) {
  std::vector<SceneExplanation> scenes;
  std::ranges::copy_if(all, std::back_inserter(scenes), [](const auto& scene) { return scene.failure.empty(); });
  TeamView view;
  for (const SceneExplanation& scene : scenes) view.materials += scene.materials.size();
  if (view.materials == 0) return view;
  const std::vector<std::string> ids = mostWorth(scenes);
  for (SwitchMask mask = 0; mask < SwitchMask{1} << ids.size(); ++mask) {
    std::vector<std::string> chosen;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if ((mask >> i & 1) != 0) chosen.push_back(ids[i]);
    TeamSet set = tryOn(scenes, std::move(chosen), view.materials);
    const auto size = static_cast<std::size_t>(std::popcount(mask));
    if (size == view.sets.size())
      view.sets.push_back(std::move(set)); // the first of its size: masks of fewer bits have come before
    else if (isBetter(set, view.sets[size]))
      view.sets[size] = std::move(set);
  }
  return view;
}

} // namespace parity::explain
