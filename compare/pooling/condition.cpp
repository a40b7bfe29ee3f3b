#include "compare/pooling/condition.h"

#include <algorithm>

#include <fmt/format.h>

namespace parity::compare {
namespace {

constexpr std::array kActsOnNames = {"figures", "whole images", "truth", "nothing"};

const Condition* findCondition(const std::vector<Condition>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Condition::name);
  return found == list.end() ? nullptr : &*found;
}

// Words that are the same hide that the values are not.
std::string describeChange(const Condition& before, const Condition& now) {
  const bool inWords = before.text() != now.text();
  return fmt::format("{} was {}, is {}", now.name, inWords ? before.text() : before.value,
                     inWords ? now.text() : now.value);
}

} // namespace

const char* nameOf(ActsOn actsOn) { return kActsOnNames.at(static_cast<std::size_t>(actsOn)); }

std::vector<Condition> overlaid(const std::vector<Condition>& ofRun, const std::vector<Condition>& ofScene) {
  std::vector<Condition> all;
  for (const Condition& condition : ofRun)
    if (!findCondition(ofScene, condition.name)) all.push_back(condition);
  all.insert(all.end(), ofScene.begin(), ofScene.end());
  return all;
}

std::vector<ConditionDifference> differencesOf(const std::vector<Condition>& before,
                                               const std::vector<Condition>& now) {
  std::vector<ConditionDifference> differences;
  for (const Condition& condition : now) {
    const Condition* then = findCondition(before, condition.name);
    if (!then)
      differences.push_back({condition.name, condition.actsOn,
                             fmt::format("{} was not recorded, is {}", condition.name, condition.text())});
    else if (then->value != condition.value)
      differences.push_back({condition.name, condition.actsOn, describeChange(*then, condition)});
  }
  for (const Condition& condition : before)
    if (!findCondition(now, condition.name))
      differences.push_back({condition.name, condition.actsOn,
                             fmt::format("{} was {}, is not recorded", condition.name, condition.text())});
  return differences;
}

} // namespace parity::compare
