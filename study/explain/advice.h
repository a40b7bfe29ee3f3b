// What would help a material, chosen from its sets and said in sentences.
#pragma once

#include <string>
#include <vector>

#include "study/explain/explanation.h"

namespace parity::explain {

// FLIP that a cheaper shader may add.
inline constexpr double kHarmless = 0.01;

// Of a material over its limit the smallest of `best` within it; where none is, the smallest that gains nine tenths of
// what there is to gain. 0: it is within, or nothing helps.
SwitchMask chooseRepair(const MaterialExplanation& material);

// The sets that sentences are about: the repair; and of `cheaper`, whose costs are there, those with a twentieth fewer
// operations or more for a FLIP that rises by at most kHarmless and not above the limit.
std::vector<SwitchMask> chooseAdvice(const MaterialExplanation& material);

// One sentence for each set that was rendered again, and of a material over its limit where its error lies.
std::vector<std::string> sentencesOf(const MaterialExplanation& material, const std::vector<Switch>& switches);

// "9 operations more", "34 % fewer operations, 1 fetch fewer", "the same cost".
std::string describeCost(const Cost& cost, const Cost& today);

} // namespace parity::explain
