#include "job/plan/unit.h"

#include <cstring>
#include <stdexcept>
#include <string_view>

#include "base/hash.h"
#include "report/record/archive.h"
#include "report/record/report_records.h"

namespace parity::job {

namespace {

// What the archive of a scene leaves out, because a cache key holds it or judging sets it.
struct LeftOut {
  std::vector<compare::Condition> conditions;
  std::vector<std::vector<compare::Condition>> views;
  std::string error; // of the report
  int errorExitCode = 0;
};

struct StageTime {
  std::string stage;
  double timeMs = 0;
};

struct InputFile {
  std::string file, hash;
};

struct Content {
  report::SceneResult result;
  LeftOut leftOut;
  std::vector<UnitFile> files;
  std::vector<InputFile> inputs;
  bool isLeftOut = false;
  std::vector<std::string> materials;
  std::string error; // for the log
  std::vector<std::string> warnings;
};

struct RunPart {
  double seconds = 0, cpuSeconds = 0;
  std::string machine;
  bool isCached = false;
  std::vector<StageTime> timings;
  std::vector<std::string> shaders;
  bool isGivenUp = false;
};

constexpr std::string_view kMagic = "PARITYU1";
constexpr std::size_t kChecksumDigits = 32;

} // namespace

} // namespace parity::job

namespace parity::report {

// A row is a line.
// clang-format off
template <> inline constexpr auto kRecord<job::LeftOut> = record<job::LeftOut>("", "",
    hidden(&job::LeftOut::conditions), hidden(&job::LeftOut::views), hidden(&job::LeftOut::error), hidden(&job::LeftOut::errorExitCode));
template <> inline constexpr auto kRecord<job::StageTime> = record<job::StageTime>("", "",
    hidden(&job::StageTime::stage), hidden(&job::StageTime::timeMs));
template <> inline constexpr auto kRecord<job::InputFile> = record<job::InputFile>("", "",
    hidden(&job::InputFile::file), hidden(&job::InputFile::hash));
template <> inline constexpr auto kRecord<job::UnitFile> = record<job::UnitFile>("", "",
    hidden(&job::UnitFile::file), hidden(&job::UnitFile::hash), hidden(&job::UnitFile::bytes));
template <> inline constexpr auto kRecord<job::Content> = record<job::Content>("", "",
    hidden(&job::Content::result), hidden(&job::Content::leftOut), hidden(&job::Content::files), hidden(&job::Content::inputs),
    hidden(&job::Content::isLeftOut), hidden(&job::Content::materials), hidden(&job::Content::error), hidden(&job::Content::warnings));
template <> inline constexpr auto kRecord<job::RunPart> = record<job::RunPart>("", "",
    hidden(&job::RunPart::seconds), hidden(&job::RunPart::cpuSeconds), hidden(&job::RunPart::machine),
    hidden(&job::RunPart::isCached), hidden(&job::RunPart::timings), hidden(&job::RunPart::shaders), hidden(&job::RunPart::isGivenUp));
template <> inline constexpr auto kRecord<job::UnitOrigin> = record<job::UnitOrigin>("", "",
    hidden(&job::UnitOrigin::plan), hidden(&job::UnitOrigin::build), hidden(&job::UnitOrigin::numerics), hidden(&job::UnitOrigin::index));
// clang-format on

} // namespace parity::report

namespace parity::job {

namespace {

template <typename T> std::vector<std::byte> archive(const T& record) {
  report::Writer write;
  write(record);
  return write.bytes();
}

Content contentOf(const Unit& unit) {
  const ComparedScene& scene = unit.scene;
  Content content;
  content.result = scene.result;
  content.files = unit.files;
  content.leftOut.conditions = scene.result.conditions;
  for (const report::ViewResult& view : scene.result.views) content.leftOut.views.push_back(view.conditions);
  content.leftOut.error = scene.result.error;
  content.leftOut.errorExitCode = scene.result.errorExitCode;
  for (const scenes::SourceFile& input : scene.inputs) content.inputs.push_back({input.file.string(), input.hash});
  content.isLeftOut = scene.isLeftOut;
  content.materials = scene.materials;
  content.error = scene.error;
  content.warnings = scene.warnings;
  return content;
}

RunPart runOf(const UnitRun& run) {
  RunPart kept{run.seconds, run.cpuSeconds, run.machine, run.isCached, {}, run.shaders, run.isGivenUp};
  for (const auto& [stage, timeMs] : run.timings) kept.timings.push_back({stage, timeMs});
  return kept;
}

Unit unitOf(Content content, RunPart run) {
  Unit unit{.scene = {}, .files = std::move(content.files), .run = {}};
  ComparedScene& scene = unit.scene;
  scene.result = std::move(content.result);
  scene.result.conditions = std::move(content.leftOut.conditions);
  if (content.leftOut.views.size() != scene.result.views.size()) throw std::out_of_range("the views' conditions");
  for (std::size_t v = 0; v < scene.result.views.size(); ++v)
    scene.result.views[v].conditions = std::move(content.leftOut.views[v]);
  scene.result.error = std::move(content.leftOut.error);
  scene.result.errorExitCode = content.leftOut.errorExitCode;
  for (const InputFile& input : content.inputs) scene.inputs.push_back({input.file, input.hash});
  scene.isLeftOut = content.isLeftOut;
  scene.materials = std::move(content.materials);
  scene.error = std::move(content.error);
  scene.warnings = std::move(content.warnings);
  scene.seconds = unit.run.seconds = run.seconds;
  scene.cpuSeconds = unit.run.cpuSeconds = run.cpuSeconds;
  scene.machine = unit.run.machine = run.machine;
  scene.isCached = unit.run.isCached = run.isCached;
  for (const StageTime& time : run.timings) unit.run.timings.emplace_back(time.stage, time.timeMs);
  unit.run.shaders = std::move(run.shaders);
  unit.run.isGivenUp = run.isGivenUp;
  return unit;
}

} // namespace

std::vector<std::byte> toBytes(const Unit& unit, const UnitOrigin& origin) {
  const std::vector<std::byte> content = archive(contentOf(unit));
  report::Writer write;
  write(origin);
  write(base::Hasher().add(content).hex());
  write(content);
  write(archive(runOf(unit.run)));
  std::vector<std::byte> bytes(kMagic.size() + kChecksumDigits);
  std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
  const std::string checksum = base::Hasher().add(write.bytes()).hex();
  std::memcpy(bytes.data() + kMagic.size(), checksum.data(), kChecksumDigits);
  bytes.insert(bytes.end(), write.bytes().begin(), write.bytes().end());
  return bytes;
}

std::optional<ReadUnit> unitFromBytes(std::span<const std::byte> bytes, const std::string& build) {
  if (bytes.size() < kMagic.size() + kChecksumDigits || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    return std::nullopt;
  const std::span<const std::byte> body = bytes.subspan(kMagic.size() + kChecksumDigits);
  const std::string checksum = base::Hasher().add(body).hex();
  if (std::memcmp(bytes.data() + kMagic.size(), checksum.data(), kChecksumDigits) != 0) return std::nullopt;
  try {
    report::Reader read(body);
    ReadUnit unit;
    read(unit.origin);
    read(unit.content);
    if (unit.origin.build != build) return unit;
    std::vector<std::byte> contentBytes, runBytes;
    read(contentBytes);
    read(runBytes);
    Content content;
    RunPart run;
    report::Reader readContent(contentBytes), readRun(runBytes);
    readContent(content);
    readRun(run);
    if (!read.atEnd() || !readContent.atEnd() || !readRun.atEnd()) return std::nullopt;
    unit.unit = unitOf(std::move(content), std::move(run));
    return unit;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

} // namespace parity::job
