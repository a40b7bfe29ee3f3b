#include "study/explain/advice.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "study/explain/asset.h"
#include "study/explain/explain.h"
#include "study/explain/ranges.h"

namespace parity::explain {

namespace {

// The share of what can be gained that a set must gain where no set meets the limit.
constexpr double kEnough = 0.9;

// Of the material with the advised repair.
double repairedFlip(const MaterialExplanation& m) { return m.flip[m.repair]; }

const SetOutcome* find(const std::vector<SetOutcome>& sets, SwitchMask mask) {
  const auto found = std::ranges::find(sets, mask, &SetOutcome::mask);
  return found == sets.end() ? nullptr : &*found;
}

bool saves(const MaterialExplanation& m, const SetOutcome& set) {
  const Cost before = find(m.best, m.repair)->cost, saved = before - set.cost;
  return saved.fetches >= 0 && 20 * saved.operations >= before.operations &&
         set.flip <= std::min(repairedFlip(m) + kHarmless, std::max(m.limit, repairedFlip(m)));
}

std::string part(const RangeShare& share) {
  return share.from > 0 ? fmt::format("above {:.1f}", share.from) : fmt::format("below {:.1f}", share.to);
}

} // namespace

SwitchMask chooseRepair(const MaterialExplanation& m) {
  const double today = m.flip.front();
  double least = today;
  for (const SetOutcome& set : m.best) least = std::min(least, set.flip);
  if (today <= m.limit || today - least < kLeastEffect) return 0;
  const double wanted = least <= m.limit ? m.limit : today - kEnough * (today - least);
  return std::ranges::find_if(m.best, [&](const SetOutcome& set) { return set.flip <= wanted; })->mask;
}

std::vector<SwitchMask> chooseAdvice(const MaterialExplanation& m) {
  std::vector<SwitchMask> all;
  if (m.repair != 0) all.push_back(m.repair);
  for (const SetOutcome& set : m.cheaper)
    if (saves(m, set)) all.push_back(set.mask);
  return all;
}

std::string describeCost(const Cost& cost, const Cost& today) {
  const Cost difference = cost - today;
  std::string text;
  const auto add = [&](std::int64_t n, std::int64_t of, const char* one, const char* many) {
    if (n == 0) return;
    const std::int64_t size = std::abs(n);
    if (!text.empty()) text += ", ";
    // Large changes in per cent.
    if (of > 0 && 20 * size >= of && size > 4)
      text += fmt::format("{:.0f} % {} {}", 100.0 * static_cast<double>(size) / static_cast<double>(of),
                          n > 0 ? "more" : "fewer", many);
    else
      text += fmt::format("{} {} {}", size, size == 1 ? one : many, n > 0 ? "more" : "fewer");
  };
  add(difference.operations, today.operations, "operation", "operations");
  add(difference.fetches, today.fetches, "fetch", "fetches");
  return text.empty() ? "the same cost" : text;
}

std::vector<std::string> sentencesOf(const MaterialExplanation& m, const std::vector<Switch>& switches) {
  std::vector<std::string> sentences;
  const double today = m.flip.front();
  const Cost costToday = m.best.front().cost;
  if (const SetOutcome* set = m.repair != 0 ? find(m.best, m.repair) : nullptr; set && set->rendered) {
    std::string text = fmt::format("{}: mean FLIP {:.3f} instead of {:.3f}, with {}", namesOf(switches, set->mask),
                                   *set->rendered, today, describeCost(set->cost, costToday));
    if (set->flip > m.limit) text += fmt::format("; no set brings it below {:g}", m.limit);
    for (const SetOutcome& alone : m.alone)
      if ((alone.mask & set->mask) != 0 && alone.mask != set->mask && alone.flip > today + kLeastEffect)
        text += fmt::format("; {} alone makes it worse ({:.3f})", namesOf(switches, alone.mask), alone.flip);
    sentences.push_back(text + ".");
  }
  if (today > m.limit && m.repair == 0) sentences.emplace_back("None of the switches brings it nearer.");
  if (m.asset)
    sentences.push_back(fmt::format("{}: {}, mean FLIP {:.3f}.",
                                    m.repair != 0 ? "Or change the asset" : "A change of the asset would help",
                                    describe(*m.asset), m.asset->flip));
  for (const SetOutcome& set : m.cheaper)
    if (set.rendered)
      sentences.push_back(fmt::format("{}: mean FLIP {:.3f} instead of {:.3f}, with {}.", namesOf(switches, set.mask),
                                      *set.rendered, today, describeCost(set.cost, costToday)));
  if (today > m.limit)
    if (const std::optional<RangeShare> worst = worstPart(m.ranges))
      sentences.push_back(fmt::format("{:.0f} % of its FLIP lies where {} is {}: {:.0f} % of its pixels.",
                                      100 * worst->error, worst->quantity, part(*worst), 100 * worst->pixels));
  return sentences;
}

} // namespace parity::explain
