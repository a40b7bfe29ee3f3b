// What sets of switches are worth: the best of each size, and each switch's share of what all of them do.
//
// A set is a mask: bit i is switch i. `values` holds a figure of every set, less being better: 2^switches of them, that
// of no switch first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace parity::explain {

using SwitchMask = std::uint32_t;

// At each size, from 0 to the number of switches, the set with the least value; of equal ones that with the least mask.
std::vector<SwitchMask> bestOfEachSize(std::span<const double> values, std::size_t switches);

// The value that the switch takes off, averaged over all orders in which the switches may be turned (Shapley 1953, "A
// Value for n-Person Games"): negative where it adds to it. Their sum is the value of no switch less that of all.
std::vector<double> shapleyValues(std::span<const double> values, std::size_t switches);

// Switches whose effect changes its sign: alone it makes the value worse by more than `least` and as the last of all
// better by more, or the other way round. One at a time says the wrong thing of them.
SwitchMask changesSign(std::span<const double> values, std::size_t switches, double least);

} // namespace parity::explain
