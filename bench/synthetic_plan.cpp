#include "bench/synthetic_plan.h"

#include <random>

#include <fmt/format.h>

#include "base/version.h"
#include "job/context.h"
#include "job/plan/merge.h"
#include "job/plan/plan_folder.h"
#include "job/plan/unit_store.h"

namespace parity::bench {
namespace {

std::vector<std::byte> makePicture(std::uint32_t seed) {
  constexpr std::size_t kBytes = 6000;
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(kBytes);
  for (std::byte& each : bytes) each = static_cast<std::byte>(random() >> 24);
  return bytes;
}

} // namespace

void writeSyntheticUnits(const std::filesystem::path& folder, const ReportSize& size, int pictures) {
  report::Report report = makeSyntheticReport(size);
  job::Plan plan;
  plan.version = base::kVersion;
  plan.build = job::hashOfThisBuild();
  plan.numerics = std::string(32, '0');
  plan.facts = {report.device, "driver", report.settings, report.conditions};
  plan.request.again = makeSyntheticRun(size).again;
  plan.shards.resize(1);
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    job::SceneRequest& scene = plan.request.scenes.emplace_back();
    scene.name = report.scenes[i].name;
    scene.scene = scene.name + ".glb";
    scene.views.resize(report.scenes[i].views.size());
    plan.shards[0].push_back(i);
  }
  job::writePlan(plan, folder);
  const job::UnitStore store(folder, plan);
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    job::ComparedScene scene;
    scene.result = std::move(report.scenes[i]);
    for (int k = 0; k < pictures; ++k)
      scene.pictures.push_back({fmt::format("images/{}-{}.png", i, k),
                                makePicture(static_cast<std::uint32_t>(i * 1000 + static_cast<std::size_t>(k)))});
    store.put(i, std::move(scene), {.seconds = 1, .timings = {{"surface", 10}}});
  }
}

void mergeSyntheticUnits(const std::filesystem::path& folder) {
  job::mergePlan(job::readPlan(folder), folder, {.folder = folder / "merged", .bench = {}}, {});
}

} // namespace parity::bench
