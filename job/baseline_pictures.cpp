#include "job/baseline_pictures.h"

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/image/image_io.h"
#include "base/log.h"

namespace parity::job {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder = "baseline/", kEnding = ".png";
constexpr std::size_t kMostPictureBytes = std::size_t{64} << 20; // of one that is held, whose size is not known

struct PngSize {
  std::size_t width = 0, height = 0;
  bool operator==(const PngSize&) const = default;
  // What a PNG of it takes at most: 4 bytes a pixel that do not compress, a byte a row, blocks and chunks.
  std::size_t mostBytes() const { return width * height * 4 + width * height / 8 + height + (std::size_t{64} << 10); }
};

// By its header; nothing where it is no PNG.
std::optional<PngSize> sizeOf(const std::vector<std::byte>& png) {
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::size_t kWidthAt = 16, kHeaderBytes = 24;
  if (png.size() < kHeaderBytes || !std::equal(kSignature.begin(), kSignature.end(), png.begin(),
                                               [](unsigned char a, std::byte b) { return std::byte{a} == b; }))
    return std::nullopt;
  const auto number = [&](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::size_t>(png[at + i]);
    return value;
  };
  return PngSize{number(kWidthAt), number(kWidthAt + 4)};
}

// Whether two files of the same size show the same; nothing where the first cannot be read.
std::optional<bool> showTheSame(const std::vector<std::byte>& before, const std::vector<std::byte>& now,
                                const PngSize& size) {
  base::ImageLimits limits;
  limits.maxSide = std::max(size.width, size.height);
  limits.maxPixels = size.width * size.height;
  try {
    return base::decodeImage8(before, "picture of the baseline", 4, limits) ==
           base::decodeImage8(now, "picture", 4, limits);
  } catch (const base::Error& error) {
    base::logDetail(error.what());
    return std::nullopt;
  }
}

// The file of this name below the folder, wherever links lead; nothing where it is elsewhere, or not there.
std::optional<fs::path> fileBelow(const fs::path& folder, const std::string& name) {
  const fs::path relative(name);
  if (name.empty() || name.find('\0') != std::string::npos || relative.is_absolute() || !name.ends_with(kEnding))
    return std::nullopt;
  if (std::ranges::any_of(relative, [](const fs::path& part) { return part == ".."; })) return std::nullopt;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return std::nullopt;
  const fs::path file = fs::canonical(root / relative, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  const auto [end, ignored] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end == root.end() ? std::optional(file) : std::nullopt;
}

// A copy of a report.json elsewhere names pictures, too, but those that lie beside it may be of a later run.
bool isReportOfItsFolder(const fs::path& file) {
  std::error_code error;
  const fs::path usual = file.parent_path() / "report.json";
  if (file.filename() == usual.filename()) return true;
  const auto size = fs::file_size(file, error);
  return !error && fs::file_size(usual, error) == size && !error && base::hashOfFile(file) == base::hashOfFile(usual);
}

template <typename Named> const Named* findNamed(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Named::name);
  return found == list.end() ? nullptr : &*found;
}

} // namespace

bool isBaselinePicture(std::string_view name) {
  return name.size() == base::kHashDigits + kEnding.size() && name.ends_with(kEnding) &&
         name.find_first_not_of("0123456789abcdef") == base::kHashDigits;
}

BaselinePictures::BaselinePictures(const report::Report& baseline, const fs::path& file, const fs::path& reportFolder)
    : m_baseline(baseline) {
  if (!isReportOfItsFolder(file)) return;
  m_folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  std::error_code none;
  m_isHeld = fs::equivalent(m_folder, reportFolder, none);
  if (m_isHeld) holdAll();
}

void BaselinePictures::holdAll() {
  std::size_t total = 0, left = 0;
  const auto hold = [&](const report::ImageSet& images) {
    for (const std::string& name : {images.reference, images.test}) {
      if (m_held.contains(name)) continue;
      const std::optional<fs::path> file = fileBelow(m_folder, name);
      if (!file) continue;
      try {
        if (total + base::regularFileSize(*file) > kMostHeldBytes) {
          ++left;
          continue;
        }
        std::vector<std::byte> bytes = base::readFile(*file, kMostPictureBytes);
        total += bytes.size();
        m_held.emplace(name, std::move(bytes));
      } catch (const base::Error& error) {
        base::logDetail(error.what());
      }
    }
  };
  for (const report::SceneResult& scene : m_baseline.scenes)
    for (const report::ViewResult& view : scene.views) {
      hold(view.images);
      for (const report::MaterialResult& material : view.materials) hold(material.crops);
    }
  if (left > 0)
    base::logWarning(fmt::format("the page does not show {} pictures of the baseline: they are in the report's own "
                                 "folder, and larger than {} MiB in all",
                                 left, kMostHeldBytes >> 20));
}

std::vector<std::byte> BaselinePictures::read(const std::string& name, std::size_t maxBytes) const {
  if (m_isHeld) {
    const auto held = m_held.find(name);
    return held == m_held.end() ? std::vector<std::byte>() : held->second;
  }
  const std::optional<fs::path> file = fileBelow(m_folder, name);
  if (!file) return {};
  try {
    return base::readFile(*file, maxBytes);
  } catch (const base::Error& error) {
    base::logDetail(error.what());
    return {};
  }
}

std::vector<std::byte> BaselinePictures::readIfChanged(const std::string& before, const std::string& now,
                                                       const OwnPicture& own) const {
  if (before.empty() || now.empty()) return {};
  const std::vector<std::byte> shown = own(now);
  const std::optional<PngSize> size = sizeOf(shown);
  if (!size) return {};
  std::vector<std::byte> bytes = read(before, size->mostBytes());
  if (bytes == shown || sizeOf(bytes) != size || showTheSame(bytes, shown, *size).value_or(true)) return {};
  return bytes;
}

void BaselinePictures::keepChanged(report::Report& report, const OwnPicture& own, const Keep& keepFile) const {
  if (m_folder.empty()) return;
  std::unordered_set<std::string> files;
  const auto keepIfChanged = [&](const std::string& before, const std::string& now) {
    std::vector<std::byte> bytes = readIfChanged(before, now, own);
    if (bytes.empty()) return std::string();
    std::string file = fmt::format("{}{}{}", kFolder, base::Hasher().add(bytes).hex(), kEnding);
    if (files.insert(file).second) keepFile({file, std::move(bytes)});
    return file;
  };
  const auto keep = [&](std::optional<report::BaselineChange>& change, const report::ImageSet& before,
                        const report::ImageSet& now) {
    if (!change) return;
    change->images.reference = keepIfChanged(before.reference, now.reference);
    change->images.test = keepIfChanged(before.test, now.test);
  };
  std::unordered_map<std::string_view, const report::SceneResult*> scenes; // the first of a name
  for (const report::SceneResult& scene : m_baseline.scenes) scenes.try_emplace(scene.name, &scene);
  for (report::SceneResult& scene : report.scenes) {
    const auto found = scenes.find(scene.name);
    if (found == scenes.end()) continue;
    const report::SceneResult* sceneBefore = found->second;
    for (report::ViewResult& view : scene.views) {
      const report::ViewResult* before = findNamed(sceneBefore->views, view.name);
      if (!before) continue;
      keep(view.baseline, before->images, view.images);
      for (report::MaterialResult& material : view.materials)
        if (const report::MaterialResult* then = findNamed(before->materials, material.name))
          keep(material.baseline, then->crops, material.crops);
    }
  }
}

} // namespace parity::job
