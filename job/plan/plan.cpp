#include "job/plan/plan.h"

#include <algorithm>
#include <cerrno>
#include <numeric>
#include <system_error>
#include <unordered_map>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/text/error_words.h"
#include "base/version.h"
#include "base/write_pieces.h"
#include "job/context.h"
#include "job/knobs.h"
#include "job/plan/plan_json.h"
#include "job/plan/unit_store.h"
#include "job/scene_times.h"
#include "report/reader.h"

namespace parity::job {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBaselineFile = "baseline.json";

// Not of what run.json alone says: another number of shards is the same plan.
std::string digestOf(Plan plan) {
  plan.request.commandLine.clear();
  plan.request.again.clear();
  return base::Hasher().add(planText(plan, false)).hex();
}

// A file that cannot be read is the scene's own error when its turn comes, or that of the run.
FrozenFiles freezeBudgets(const ReportRequest& request, const Settings& settings) {
  FrozenFiles frozen;
  const RunBudgets budgets(settings.budgets, request.suiteBudgets);
  for (const SceneRequest& scene : request.scenes)
    if (const std::optional<std::string> file = budgets.fileOf(scene); file && !frozen.contains(*file)) {
      try {
        frozen[*file] = base::readText(*file);
      } catch (const base::Error&) {
      }
    }
  return frozen;
}

// Sets the digest.
bool holdsAnother(Plan& plan, const fs::path& folder) {
  plan.digest = digestOf(plan);
  std::error_code error;
  if (!fs::exists(folder / kPlanFile, error)) return false;
  try {
    return readPlan(folder).digest != plan.digest;
  } catch (const base::Error&) { // of another build, or damaged
    return true;
  }
}

fs::path baselineFile(const fs::path& folder, std::size_t scene) {
  return folder / "baseline" / fmt::format("{:06}.json", scene);
}

// Workers read what it says of their scenes alone: all of it may be a gigabyte.
void writeBaseline(const Plan& plan, const fs::path& folder) {
  const std::vector<std::byte> bytes = base::readFile(plan.request.baseline);
  base::writeBytes(folder / kBaselineFile, bytes);
  report::Report baseline = report::readReport(folder / kBaselineFile);
  std::unordered_map<std::string, std::vector<report::SceneResult>> scenes;
  for (report::SceneResult& scene : baseline.scenes) scenes[scene.name].push_back(std::move(scene));
  for (std::size_t i = 0; i < plan.request.scenes.size(); ++i) {
    const auto found = scenes.find(plan.request.scenes[i].name);
    if (found == scenes.end()) continue;
    baseline.scenes = std::move(found->second);
    base::writePieces(baselineFile(folder, i), [&](const base::TextSink& sink) { report::writeJson(baseline, sink); });
  }
}

void write(const Plan& plan, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw base::fileError(folder.string(), "", "cannot be created as a folder: " + error.message());
  if (!plan.request.baseline.empty()) writeBaseline(plan, folder);
  if (fs::exists(folder / kPlanFile, error)) UnitStore(folder, plan).dropOutdated();
  base::writeText(folder / kPlanFile, planText(plan, true)); // the last: whoever sees it may begin
}

} // namespace

Settings Plan::settings() const { return defaultsOf({}, plain, given); }

Plan makePlan(Context& context, ReportRequest request, const Settings& plain, const base::GivenKnobs& given,
              std::size_t shards) {
  Plan plan{base::kVersion, hashOfThisBuild(), context.numerics(), factsOf(context), plain, given, {}, {}, {}, {}, {}};
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

fs::path baselineOf(const Plan& plan, const fs::path& folder) {
  fs::path file = folder / kBaselineFile;
  if (base::hashOfFile(file) != plan.baseline)
    throw base::Error(base::ExitCode::otherPlan, file.string(), "", "is not the baseline of the plan");
  return file;
}

fs::path baselineOf(const fs::path& folder, std::size_t scene) {
  fs::path file = baselineFile(folder, scene);
  std::error_code none;
  return fs::exists(file, none) ? file : fs::path();
}

PlanLock::PlanLock(const fs::path& folder)
    : m_descriptor(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (m_descriptor >= 0 && ::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(m_descriptor);
    throw base::Error(base::ExitCode::incomplete, folder.string(), "",
                      "another process merges this plan; try again when it is done");
  }
}

PlanLock::~PlanLock() {
  if (m_descriptor >= 0) ::close(m_descriptor);
}

void writePlan(Plan& plan, const fs::path& folder) {
  if (holdsAnother(plan, folder))
    throw base::Error(base::ExitCode::usage, folder.string(), kPlanFile,
                      "the folder holds another plan; remove it, or give another folder");
  write(plan, folder);
}

void writePlanAnew(Plan& plan, const fs::path& folder) {
  std::error_code error;
  if (holdsAnother(plan, folder)) fs::remove_all(folder, error);
  if (error) throw base::fileError(folder.string(), "", "cannot be removed: " + error.message());
  write(plan, folder);
}

Plan readPlan(const fs::path& folder) {
  const fs::path file = folder / kPlanFile;
  const std::string text = base::readText(file);
  Plan plan;
  try {
    plan = planFromText(text);
  } catch (const base::Error& error) {
    throw base::fileError(file.string(), "", std::string("is not a plan of this version: ") + error.what());
  } catch (const std::exception& error) {
    throw base::fileError(file.string(), "", "is not a plan of this version: " + base::wordsOf(error));
  }
  if (plan.version != base::kVersion || plan.build != hashOfThisBuild())
    throw base::Error(base::ExitCode::otherPlan, file.string(), "",
                      fmt::format("was made by another build of parity ({}); use the same build for plan, work and "
                                  "merge",
                                  plan.version));
  plan.digest = digestOf(plan);
  return plan;
}

} // namespace parity::job
