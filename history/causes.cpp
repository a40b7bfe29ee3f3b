#include "history/causes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace parity::history {

std::string causesOf(const Makers& beforeRun, const report::SceneInputs& before, const Makers& nowRun,
                     const report::SceneInputs& now) {
  std::vector<const char*> names;
  const auto hold = [&](const char* name, const std::string& a, const std::string& b) {
    if (a != b) names.push_back(name);
  };
  hold("asset", before.asset, now.asset);
  hold("environment", before.environment, now.environment);
  hold("request", before.request, now.request);
  hold("bake", before.bake, now.bake);
  hold("pictures", before.pictures, now.pictures);
  hold("build", beforeRun.build, nowRun.build);
  hold("device", beforeRun.device, nowRun.device);
  hold("driver", beforeRun.driver, nowRun.driver);
  hold("numerics", beforeRun.numerics, nowRun.numerics);
  hold("settings", beforeRun.settings, nowRun.settings);
  return fmt::format("{}", fmt::join(names, ","));
}

std::string judgingCause(const Makers& before, const Makers& now) {
  return before.budgets != now.budgets ? "budgets" : "judging";
}

} // namespace parity::history
