#include "job/plan/plan.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/version.h"
#include "compare/verdict/approval.h"
#include "job/context.h"
#include "job/knobs.h"
#include "job/scene_times.h"
#include "report/reader.h"

namespace parity::job {

namespace {

// A budget file that cannot be read is the scene's own error when its turn comes, or that of the run.
FrozenFiles freezeBudgets(const ReportRequest& request, const Settings& settings) {
  FrozenFiles frozen;
  const RunBudgets budgets(settings.budgets, request.suiteBudgets);
  if (request.baseline.empty()) budgets.requireLevels();
  for (const SceneRequest& scene : request.scenes)
    if (const std::optional<std::string> file = budgets.fileOf(scene); file && !frozen.contains(*file)) {
      try {
        frozen[*file] = base::readText(*file);
      } catch (const base::Error&) {
      }
    }
  if (!request.approvals.empty()) {
    frozen[request.approvals] = base::readText(request.approvals);
    compare::readApprovals(frozen[request.approvals], request.approvals); // what is wrong with it is said now
  }
  return frozen;
}

} // namespace

Settings Plan::settings() const { return defaultsOf({}, plain, given); }

Plan makePlan(Context& context, ReportRequest request, const Settings& plain, const base::GivenKnobs& given,
              std::size_t shards) {
  for (SceneRequest& scene : request.scenes) scene.given = withPinnedFolders(scene.given, scene.settings);
  Plan plan{base::kVersion,
            hashOfThisBuild(),
            context.numerics(),
            factsOf(context),
            plain,
            withPinnedFolders(given, defaultsOf({}, plain, given)),
            {},
            {},
            {},
            {},
            {},
            {}};
  plan.budgets = freezeBudgets(request, context.settings());
  if (!request.baseline.empty()) {
    request.baseline = report::reportFileOf(request.baseline); // as it is named now: at the merge it may be gone
    plan.baseline = base::hashOfFile(request.baseline);
  }
  plan.shards = packShards(request.scenes.size(), estimateTimes(context.cache(), request.scenes).seconds, shards);
  plan.request = std::move(request);
  return plan;
}

std::uintmax_t expectedCacheBytes(const ReportRequest& request) {
  constexpr std::uintmax_t kBytesAPixel = 12;
  if (request.pictures == Pictures::none) return 0;
  std::uintmax_t pixels = 0;
  for (const SceneRequest& scene : request.scenes)
    pixels += static_cast<std::uintmax_t>(scene.settings.width) * static_cast<std::uintmax_t>(scene.settings.height) *
              scene.views.size();
  return pixels * kBytesAPixel;
}

std::vector<std::vector<std::size_t>> packShards(std::size_t scenes, const std::vector<double>& seconds,
                                                 std::size_t shards) {
  std::vector<std::size_t> order(scenes);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto time = [&](std::size_t scene) { return seconds.empty() ? 1.0 : seconds[scene]; };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return time(a) > time(b); });
  std::vector<std::vector<std::size_t>> packed(shards);
  std::vector<double> sums(shards);
  for (const std::size_t scene : order) {
    const auto least = static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin());
    packed[least].push_back(scene);
    sums[least] += time(scene);
  }
  return packed;
}

} // namespace parity::job
