#include "study/explain/sets.h"

#include <bit>
#include <cassert>

namespace parity::explain {

std::vector<SwitchMask> bestOfEachSize(std::span<const double> values, std::size_t switches) {
  assert(values.size() == std::size_t{1} << switches);
  std::vector<SwitchMask> best;
  for (std::size_t size = 0; size <= switches; ++size) {
    SwitchMask least = (SwitchMask{1} << size) - 1; // the first of that size
    for (SwitchMask mask = least; mask < values.size(); ++mask)
      if (static_cast<std::size_t>(std::popcount(mask)) == size && values[mask] < values[least]) least = mask;
    best.push_back(least);
  }
  return best;
}

std::vector<double> shapleyValues(std::span<const double> values, std::size_t switches) {
  assert(values.size() == std::size_t{1} << switches);
  // Orders in which `before` switches come first, of all orders: before! (n - 1 - before)! / n!.
  std::vector<double> share(switches, 1.0 / static_cast<double>(switches > 0 ? switches : 1));
  for (std::size_t before = 1; before < switches; ++before)
    share[before] = share[before - 1] * static_cast<double>(before) / static_cast<double>(switches - before);
  std::vector<double> worth(switches, 0);
  for (SwitchMask mask = 0; mask < values.size(); ++mask)
    for (std::size_t i = 0; i < switches; ++i) {
      const SwitchMask bit = SwitchMask{1} << i;
      if ((mask & bit) == 0)
        worth[i] += share[static_cast<std::size_t>(std::popcount(mask))] * (values[mask] - values[mask | bit]);
    }
  return worth;
}

SwitchMask changesSign(std::span<const double> values, std::size_t switches, double least) {
  const SwitchMask all = (SwitchMask{1} << switches) - 1;
  SwitchMask changing = 0;
  for (std::size_t i = 0; i < switches; ++i) {
    const SwitchMask bit = SwitchMask{1} << i;
    const double alone = values[0] - values[bit], last = values[all & ~bit] - values[all];
    if ((alone < -least && last > least) || (alone > least && last < -least)) changing |= bit;
  }
  return changing;
}

} // namespace parity::explain
