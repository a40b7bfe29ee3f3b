#include "job/plan/unit_store.h"

#include <algorithm>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"

namespace parity::job {

namespace {

namespace fs = std::filesystem;

constexpr const char *kUnit = "unit", *kOther = "other", *kCrash = "crash", *kBegun = "begun";

// Below the folder, wherever it is put: a unit that somebody wrote by hand must not reach other files.
bool isSafe(const UnitFile& file) {
  const fs::path name = file.file;
  return !name.empty() && name.is_relative() && name.has_filename() &&
         std::ranges::none_of(name, [](const fs::path& part) { return part == ".."; }) &&
         file.hash.size() == base::kHashDigits && file.hash.find_first_not_of("0123456789abcdef") == std::string::npos;
}

} // namespace

UnitStore::UnitStore(fs::path folder, const Plan& plan) : m_folder(std::move(folder)), m_plan(plan) {}

fs::path UnitStore::fileOf(std::size_t index, const char* ending) const {
  return m_folder / "units" / fmt::format("{:06}.{}", index, ending);
}

// Folders of at most 256 names: tens of thousands in one are slow on network file systems.
fs::path UnitStore::blobOf(const std::string& hash) const { return m_folder / "pictures" / hash.substr(0, 2) / hash; }

UnitFile UnitStore::keep(const EncodedPicture& picture) const {
  UnitFile file{picture.file, base::Hasher().add(picture.bytes).hex(), picture.bytes.size()};
  const fs::path blob = blobOf(file.hash);
  std::error_code none;
  if (fs::exists(blob, none) && fs::file_size(blob, none) != file.bytes) fs::remove(blob, none);
  base::writeOnce(blob, picture.bytes);
  return file;
}

ReadUnit UnitStore::readWhole(const fs::path& file) const {
  const std::vector<std::byte> bytes = base::readFile(file);
  std::optional<ReadUnit> unit = unitFromBytes(bytes, m_plan.build);
  if (!unit) throw base::fileError(file.string(), "", "is damaged");
  const auto refuse = [&](const std::string& what) {
    throw base::Error(base::ExitCode::otherPlan, file.string(), "", "is of another " + what);
  };
  if (unit->origin.build != m_plan.build) refuse("build of parity");
  if (unit->origin.plan != m_plan.digest) refuse("plan");
  if (unit->origin.numerics != m_plan.numerics) refuse("kind of machine, which rounds otherwise (numerics id)");
  return std::move(*unit);
}

bool UnitStore::has(std::size_t index) const {
  std::error_code none;
  return fs::exists(fileOf(index, kUnit), none);
}

std::string UnitStore::findFault(std::size_t index) const {
  try {
    const Unit unit = read(index);
    for (const UnitFile& file : unit.files) {
      std::error_code error;
      if (const std::uintmax_t size = fs::file_size(blobOf(file.hash), error); error || size != file.bytes)
        return fmt::format("{}: its picture {} is missing or damaged", fileOf(index, kUnit).string(), file.file);
    }
    return {};
  } catch (const base::Error& error) {
    return error.what();
  }
}

std::vector<std::size_t> UnitStore::missing() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < m_plan.request.scenes.size(); ++i)
    if (!findFault(i).empty()) list.push_back(i);
  sortByBegun(list);
  return list;
}

std::vector<std::size_t> UnitStore::missing(std::size_t shard) const {
  std::vector<std::size_t> list = m_plan.shards.at(shard);
  std::erase_if(list, [&](std::size_t i) { return findFault(i).empty(); });
  sortByBegun(list);
  return list;
}

std::uintmax_t UnitStore::timesBegun(std::size_t index) const {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(fileOf(index, kBegun), error); // a byte each
  return error ? 0 : bytes;
}

bool UnitStore::wasBegun(std::size_t index) const { return timesBegun(index) > 0; }

void UnitStore::sortByBegun(std::vector<std::size_t>& units) const {
  std::map<std::size_t, std::uintmax_t> times;
  for (const std::size_t unit : units) times[unit] = timesBegun(unit);
  std::ranges::stable_sort(units, {}, [&](std::size_t unit) { return times[unit]; });
}

void UnitStore::noteBegun(std::size_t index) const {
  const fs::path file = fileOf(index, kBegun);
  const std::string text(static_cast<std::size_t>(timesBegun(index) + 1), '.');
  try {
    base::replaceDurably(file, std::as_bytes(std::span{text})); // the machine may go down at once
  } catch (const base::Error& error) {
    base::logDetail(error.what());
  }
}

void UnitStore::forgetBegun(std::size_t index) const {
  std::error_code none;
  fs::remove(fileOf(index, kBegun), none);
}

void UnitStore::dropOutdated() const {
  std::error_code none;
  if (!fs::exists(m_folder / "units", none)) return;
  std::map<fs::path, std::string> hashes; // of files as they are now; empty: not there
  const auto hashOf = [&](const fs::path& file) -> const std::string& {
    const auto [entry, isNew] = hashes.try_emplace(file);
    try {
      if (isNew) entry->second = base::hashOfFile(file);
    } catch (const base::Error& error) {
      base::logDetail(error.what());
    }
    return entry->second;
  };
  for (std::size_t i = 0; i < m_plan.request.scenes.size(); ++i) {
    try {
      const ComparedScene scene = read(i).scene;
      const auto isSame = [&](const scenes::SourceFile& input) { return hashOf(input.file) == input.hash; };
      if (scene.result.error.empty() && std::ranges::all_of(scene.inputs, isSame)) continue;
    } catch (const base::Error& error) { // it is done anew anyway
      base::logDetail(error.what());
    }
    for (const char* ending : {kUnit, kOther, kCrash, kBegun}) fs::remove(fileOf(i, ending), none);
  }
}

void UnitStore::put(std::size_t index, ComparedScene scene, UnitRun run) const {
  Unit unit{.scene = {}, .files = {}, .run = std::move(run)};
  for (const EncodedPicture& picture : scene.pictures) unit.files.push_back(keep(picture));
  scene.pictures.clear();
  const bool isGivenUp = unit.run.isGivenUp;
  unit.scene = std::move(scene);
  const std::vector<std::byte> bytes = toBytes(unit, {m_plan.digest, m_plan.build, m_plan.numerics, index});
  const fs::path file = fileOf(index, kUnit);
  if (base::writeOnce(file, bytes)) return;
  if (findFault(index).empty()) {
    if (isGivenUp) return; // who could do it is right
    const ReadUnit before = readWhole(file);
    if (!before.unit->run.isGivenUp) {
      if (before.content != unitFromBytes(bytes, m_plan.build)->content) base::writeOnce(fileOf(index, kOther), bytes);
      return;
    }
  }
  base::logDetail(fmt::format("{}: is replaced", file.string()));
  base::replaceDurably(file, bytes);
}

Unit UnitStore::read(std::size_t index) const {
  ReadUnit unit = readWhole(fileOf(index, kUnit));
  if (unit.origin.index != index || !unit.unit || unit.unit->scene.result.name != m_plan.request.scenes.at(index).name)
    throw base::fileError(fileOf(index, kUnit).string(), "", "is the unit of another scene");
  if (!std::ranges::all_of(unit.unit->files, isSafe))
    throw base::fileError(fileOf(index, kUnit).string(), "", "is damaged: it names files elsewhere");
  return std::move(*unit.unit);
}

bool UnitStore::differs(std::size_t index) const {
  std::error_code none;
  if (!fs::exists(fileOf(index, kOther), none)) return false;
  try {
    return readWhole(fileOf(index, kOther)).content != readWhole(fileOf(index, kUnit)).content;
  } catch (const base::Error&) { // of an earlier plan, or half a file
    return false;
  }
}

void UnitStore::noteCrash(std::size_t index, const std::string& words) const {
  base::writeText(fileOf(index, kCrash), m_plan.digest + "\n" + words + "\n");
}

std::string UnitStore::crashOf(std::size_t index) const {
  std::error_code none;
  if (!fs::exists(fileOf(index, kCrash), none)) return {};
  const std::string text = base::readText(fileOf(index, kCrash));
  if (!text.starts_with(m_plan.digest + "\n")) return {};
  return text.substr(m_plan.digest.size() + 1, text.size() - m_plan.digest.size() - 2);
}

void UnitStore::place(const UnitFile& file, const fs::path& folder) const {
  const fs::path to = folder / file.file;
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  fs::remove(to, error); // never written over: it may be a link to another picture, or another scene's same texture
  fs::create_hard_link(blobOf(file.hash), to, error);
  if (!error) return;
  fs::copy_file(blobOf(file.hash), to, error);
  if (error) throw base::fileError(to.string(), "cannot be written", error.message());
}

std::vector<std::byte> UnitStore::contentOf(const UnitFile& file) const { return base::readFile(blobOf(file.hash)); }

} // namespace parity::job
