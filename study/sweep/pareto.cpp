#include "study/sweep/pareto.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "compare/pooling/figure_list.h"
#include "study/sweep/statistics.h"

namespace parity::sweep {

const std::vector<std::string>& errorNames() {
  static const std::vector<std::string> names = {"flip.mean", "flip.p95", "relmse"};
  return names;
}

double errorOf(const Errors& errors, const std::string& name) {
  return name == "flip.mean" ? errors.flipMean : name == "flip.p95" ? errors.flipP95 : errors.relMse;
}

std::string firstPathOf(const SweepReport& report) {
  for (const SceneSweep& scene : report.scenes)
    if (!scene.variants.empty()) return scene.variants.front().path;
  return "first";
}

const VariantResult* findVariant(const SceneSweep& scene, const std::string& id) {
  const auto found = std::ranges::find_if(scene.variants, [&](const VariantResult& v) { return v.id() == id; });
  return found == scene.variants.end() ? nullptr : &*found;
}

std::optional<double> errorOf(const RegionErrors& region, Against against, const std::string& figure) {
  if (against == Against::first) return errorOf(region.first, figure);
  return region.truth ? std::optional(errorOf(*region.truth, figure)) : std::nullopt;
}

Against bestKnown(const SweepReport& report) {
  const auto hasTruth = [](const SceneSweep& scene) {
    return !scene.failure.empty() || (!scene.variants.empty() && scene.variants.front().whole.truth.has_value());
  };
  return std::ranges::all_of(report.scenes, hasTruth) ? Against::truth : Against::first;
}

const std::vector<double>& timesOf(const VariantResult& v) {
  return v.stage == Stage::preparation ? v.prepareMs : v.times.deviceMs;
}

double timeOf(const VariantResult& v) { return spreadOf(timesOf(v)).median; }

namespace {

double errorOrInfinite(const VariantResult& v, Against against, const std::string& figure) {
  const double error = errorOf(v.whole, against, figure).value_or(std::numeric_limits<double>::infinity());
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

} // namespace

std::vector<bool> findDominated(const SceneSweep& scene, Against against, const std::string& figure) {
  std::vector<bool> dominated;
  for (const VariantResult& v : scene.variants) {
    const Spread times = spreadOf(timesOf(v));
    const double error = errorOrInfinite(v, against, figure);
    if (v.stage == Stage::storage) {
      dominated.push_back(false);
      continue;
    }
    dominated.push_back(std::isinf(error) || std::ranges::any_of(scene.variants, [&](const VariantResult& other) {
                          if (other.path != v.path || other.stage != v.stage) return false;
                          if (v.stage == Stage::preparation && other.knob != v.knob) return false; // another work
                          const Spread others = spreadOf(timesOf(other));
                          const double e = errorOrInfinite(other, against, figure);
                          const bool isFaster = others.high<times.low, isSlower = others.low> times.high;
                          return isFaster ? e <= error : !isSlower && e < error;
                        }));
  }
  return dominated;
}

std::vector<std::string> dominatedEverywhere(const SweepReport& report, Against against, const std::string& figure) {
  std::vector<std::string> order;
  std::map<std::string, bool> everywhere;
  for (const SceneSweep& scene : report.scenes) {
    const std::vector<bool> dominated = findDominated(scene, against, figure);
    for (std::size_t i = 0; i < dominated.size(); ++i) {
      const auto [at, isNew] = everywhere.emplace(scene.variants[i].id(), true);
      if (isNew) order.push_back(at->first);
      at->second = at->second && dominated[i];
    }
  }
  std::erase_if(order, [&](const std::string& id) { return !everywhere[id]; });
  return order;
}

ErrorBudget parseErrorBudget(const std::string& text) {
  const auto equals = text.find('=');
  ErrorBudget budget;
  const char* end = text.data() + text.size();
  const char* begin = equals == std::string::npos ? end : text.data() + equals + 1;
  const auto [stop, error] = std::from_chars(begin, end, budget.limit);
  const std::string place = "--budget " + text;
  if (error != std::errc() || stop != end || !(budget.limit > 0) || !std::isfinite(budget.limit))
    throw base::Error(base::ExitCode::usage, "bench", place,
                      fmt::format("is not NAME=LIMIT with {} and a positive number", fmt::join(errorNames(), ", ")));
  const std::vector<compare::Statistic> figures = compare::parseFigures(text.substr(0, equals), "bench");
  budget.figure = figures.front().name;
  if (figures.size() != 1 || std::ranges::find(errorNames(), budget.figure) == errorNames().end())
    throw base::Error(
        base::ExitCode::usage, "bench", place,
        fmt::format("'{}' is not measured; give one of {}", text.substr(0, equals), fmt::join(errorNames(), ", ")));
  return budget;
}

std::optional<std::string> cheapestWithin(const SceneSweep& scene, const std::string& path, Against against,
                                          const ErrorBudget& budget) {
  const VariantResult* best = nullptr;
  for (const VariantResult& v : scene.variants)
    if (v.path == path && v.stage == Stage::shading && errorOrInfinite(v, against, budget.figure) <= budget.limit &&
        (best == nullptr || timeOf(v) < timeOf(*best)))
      best = &v;
  return best ? std::optional(best->name) : std::nullopt;
}

std::optional<std::string> cheapestWithinEverywhere(const SweepReport& report, const std::string& path, Against against,
                                                    const ErrorBudget& budget) {
  struct Sum {
    double share = 0;
    bool within = true;
    std::size_t scenes = 0;
  };
  std::map<std::string, Sum> sums;
  std::size_t measured = 0;
  for (const SceneSweep& scene : report.scenes) {
    if (!scene.failure.empty()) continue;
    ++measured;
    const VariantResult* plain = findVariant(scene, path + ": default");
    for (const VariantResult& v : scene.variants) {
      if (v.path != path || v.stage != Stage::shading) continue;
      Sum& sum = sums[v.name];
      sum.share += timeOf(v) / timeOf(*plain);
      sum.within = sum.within && errorOrInfinite(v, against, budget.figure) <= budget.limit;
      ++sum.scenes;
    }
  }
  std::optional<std::string> best;
  for (const auto& [name, sum] : sums)
    if (sum.within && sum.scenes == measured && (!best || sum.share < sums[*best].share)) best = name;
  return best;
}

std::vector<Purchase> rankPurchases(const SweepReport& report, Against against, const std::string& figure) {
  struct Steps {
    std::vector<double> timeMs, error;
    std::size_t apart = 0;
    double defaultMs = 0;
    Purchase purchase;
  };
  std::map<std::string, Steps> all;
  for (const SceneSweep& scene : report.scenes)
    for (const VariantResult& v : scene.variants) {
      if (v.knob.empty() || v.stage != Stage::shading) continue;
      const VariantResult& plain = *findVariant(scene, v.path + ": default");
      const double error = errorOrInfinite(v, against, figure), best = errorOrInfinite(plain, against, figure);
      if (!std::isfinite(error) || !std::isfinite(best)) continue;
      const Spread turned = spreadOf(v.times.deviceMs), usual = spreadOf(plain.times.deviceMs);
      const double perMillion = 1e6 / static_cast<double>(scene.pixels);
      Steps& steps = all[v.id()];
      steps.timeMs.push_back((turned.median - usual.median) * perMillion);
      steps.error.push_back(best - error);
      steps.apart += turned.low > usual.high || turned.high < usual.low;
      steps.defaultMs += usual.median * perMillion;
      const auto value = [&](const VariantResult& of) {
        const auto found = std::ranges::find(of.knobs, v.knob, [](const auto& each) { return each.first; });
        return found == of.knobs.end() ? std::string("?") : found->second;
      };
      steps.purchase = {v.path, v.knob, value(plain), value(v)};
    }
  std::vector<Purchase> ranked;
  for (auto& [id, steps] : all) {
    const auto scenes = static_cast<double>(steps.timeMs.size());
    Purchase p = steps.purchase;
    p.certain = static_cast<double>(steps.apart) / scenes;
    p.timeMs = quantileOf(steps.timeMs, 0.5);
    p.error = quantileOf(steps.error, 0.5);
    const bool apart = p.certain > 0.5;
    if (apart ? p.timeMs < 0 : p.error < 0) { // the default is what is bought
      std::swap(p.from, p.to);
      p.timeMs = -p.timeMs;
      p.error = -p.error;
    }
    const double least = 0.01 * steps.defaultMs / scenes;
    p.perMs = p.error / (apart ? std::max(p.timeMs, least) : least);
    ranked.push_back(std::move(p));
  }
  std::ranges::stable_sort(ranked, [](const Purchase& a, const Purchase& b) { return a.perMs > b.perMs; });
  return ranked;
}

} // namespace parity::sweep
