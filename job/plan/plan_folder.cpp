#include "job/plan/plan_folder.h"

#include <system_error>
#include <unordered_map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/text/error_words.h"
#include "base/version.h"
#include "base/write_pieces.h"
#include "job/context.h"
#include "job/plan/plan_json.h"
#include "job/plan/unit_store.h"
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

fs::path requireHash(const fs::path& file, const std::string& hash) {
  std::error_code none;
  if (!fs::exists(file, none) || base::hashOfFile(file) != hash)
    throw base::Error(base::ExitCode::otherPlan, file.string(), "", "is not the baseline of the plan");
  return file;
}

// Workers read what it says of their scenes alone: all of it may be a gigabyte.
void writeBaseline(Plan& plan, const fs::path& folder) {
  base::writeAtomically(folder / kBaselineFile, [&](const fs::path& temporary) {
    std::error_code error;
    fs::copy_file(plan.request.baseline, temporary, error);
    if (error) throw base::fileError((folder / kBaselineFile).string(), "cannot be written", error.message());
  });
  requireHash(folder / kBaselineFile, plan.baseline); // it may be written at the moment
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

fs::path baselineOf(const Plan& plan, const fs::path& folder) {
  return requireHash(folder / kBaselineFile, plan.baseline);
}

fs::path baselineOf(const Plan& plan, const fs::path& folder, std::size_t scene) {
  const std::string& hash = plan.sceneBaselines.at(scene);
  return hash.empty() ? fs::path() : requireHash(baselineFile(folder, scene), hash);
}

PlanLock::PlanLock(const fs::path& folder)
    : m_lock(folder / kLockFile, folder.string(), "another process merges this plan; try again when it is done") {}

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
    if (error.code() == base::ExitCode::failed) throw; // a preset folder, not the plan
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
