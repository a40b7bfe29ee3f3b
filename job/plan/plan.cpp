#include "job/plan/plan.h"

#include <algorithm>
#include <cerrno>
#include <numeric>
#include <system_error>
#include <unordered_map>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
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

constexpr std::size_t kShown = 12; // digits of a build's hash, as of `parity --version`
constexpr const char *kBaselineFile = "baseline.json", *kLockFile = "lock";

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

int openLock(const fs::path& file) { return ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666); }

bool isSameFile(int descriptor, const fs::path& file) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

fs::path requireHash(const fs::path& file, const std::string& hash) {
  std::error_code none;
  if (!fs::exists(file, none) || base::hashOfFile(file) != hash)
    throw base::Error(base::ExitCode::otherPlan, file.string(), "", "is not the baseline of the plan");
  return file;
}

// Workers read what it says of their scenes alone: all of it may be a gigabyte.
void writeBaseline(Plan& plan, const fs::path& folder) {
  const std::vector<std::byte> bytes = base::readFile(plan.request.baseline);
  base::writeBytes(folder / kBaselineFile, bytes);
  report::Report baseline = report::readReport(folder / kBaselineFile);
  std::unordered_map<std::string, std::vector<report::SceneResult>> scenes;
  for (report::SceneResult& scene : baseline.scenes) scenes[scene.name].push_back(std::move(scene));
  plan.sceneBaselines.assign(plan.request.scenes.size(), {});
  for (std::size_t i = 0; i < plan.request.scenes.size(); ++i) {
    const auto found = scenes.find(plan.request.scenes[i].name);
    if (found == scenes.end()) continue;
    baseline.scenes = std::move(found->second);
    base::writePieces(baselineFile(folder, i), [&](const base::TextSink& sink) { report::writeJson(baseline, sink); });
    plan.sceneBaselines[i] = base::hashOfFile(baselineFile(folder, i));
  }
}

void write(Plan& plan, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw base::fileError(folder.string(), "", "cannot be created as a folder: " + error.message());
  if (!plan.request.baseline.empty()) writeBaseline(plan, folder);
  UnitStore(folder, plan).dropOutdated();
  base::writeText(folder / kPlanFile, planText(plan, true)); // the last: whoever sees it may begin
}

} // namespace

Settings Plan::settings() const { return defaultsOf({}, plain, given); }

Plan makePlan(Context& context, ReportRequest request, const Settings& plain, const base::GivenKnobs& given,
              std::size_t shards) {
  Plan plan{
      base::kVersion, hashOfThisBuild(), context.numerics(), factsOf(context), plain, given, {}, {}, {}, {}, {}, {}};
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
  return requireHash(folder / kBaselineFile, plan.baseline);
}

fs::path baselineOf(const Plan& plan, const fs::path& folder, std::size_t scene) {
  const std::string& hash = plan.sceneBaselines.at(scene);
  return hash.empty() ? fs::path() : requireHash(baselineFile(folder, scene), hash);
}

PlanLock::PlanLock(const fs::path& folder) : m_descriptor(openLock(folder / kLockFile)) {
  while (m_descriptor >= 0) {
    if (::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return; // a file system without locks
      ::close(m_descriptor);
      throw base::Error(base::ExitCode::incomplete, folder.string(), "",
                        "another process merges this plan; try again when it is done");
    }
    if (isSameFile(m_descriptor, folder / kLockFile)) return;
    ::close(m_descriptor); // its owner has removed it just now
    m_descriptor = openLock(folder / kLockFile);
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
  if (holdsAnother(plan, folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().filename() != kLockFile && !error) fs::remove_all(entry.path(), error);
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
    throw base::fileError(file.string(), "", std::string("is damaged, or a plan of another version: ") + error.what());
  } catch (const std::exception& error) {
    throw base::fileError(file.string(), "", "is damaged, or a plan of another version: " + base::wordsOf(error));
  }
  if (plan.version != base::kVersion || plan.build != hashOfThisBuild())
    throw base::Error(
        base::ExitCode::otherPlan, file.string(), "",
        fmt::format("was made by another build of parity ({} {}, here {} {}); use the same build for plan, "
                    "work and merge",
                    plan.version, plan.build.substr(0, kShown), base::kVersion, hashOfThisBuild().substr(0, kShown)));
  plan.digest = digestOf(plan);
  return plan;
}

} // namespace parity::job
