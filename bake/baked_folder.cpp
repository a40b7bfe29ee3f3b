#include "bake/baked_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include "bake/baked_objects.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/image/image_io.h"
#include "base/text/error_words.h"
#include "lighting/environment/cube.h"
#include "shading/half.h"

namespace parity::bake {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "parity-bake";
constexpr int kVersion = 1;
constexpr std::size_t kMaxManifestBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxPages = 1024, kMaxCaptures = 64;

using base::hashOfFile;

// Whether it holds a bake and nothing else: every entry is one that its manifest lists.
bool holdsOnlyABake(const fs::path& folder) {
  try {
    const Json manifest = Json::parse(base::readText(folder / kManifestFile, kMaxManifestBytes));
    if (!manifest.is_object() || manifest.value("format", "") != kFormat) return false;
    const Json& files = manifest.at("files");
    return std::ranges::all_of(fs::directory_iterator(folder), [&](const fs::directory_entry& entry) {
      const std::string name = entry.path().filename().string();
      return name == kManifestFile || files.contains(name);
    });
  } catch (const std::exception&) {
    return false;
  }
}

// ---- captures

// The six faces of the unfiltered cube, one above the other: for eyes.
base::Image facesOf(const lighting::CubeMap& cube) {
  base::Image image(cube.faceSize, cube.faceSize * lighting::kCubeFaces, 3);
  for (std::size_t i = 0; i < image.pixelCount(); ++i)
    for (int c = 0; c < 3; ++c) image.pixels[3 * i + static_cast<std::size_t>(c)] = cube.mips[0][i][c];
  return image;
}

// ---- 16-bit floats, which files hold as what 32 bits read

base::Image widened(const base::BasicImage<std::uint16_t>& halves) {
  base::Image image(halves.width, halves.height, halves.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(shading::Half::fromBits(halves.pixels[i]));
  return image;
}

base::BasicImage<std::uint16_t> narrowed(const base::Image& image) {
  base::BasicImage<std::uint16_t> halves(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) halves.pixels[i] = shading::Half(image.pixels[i]).bits();
  return halves;
}

Json toJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

glm::vec3 vectorOf(const Json& list) {
  return {list.at(0).get<float>(), list.at(1).get<float>(), list.at(2).get<float>()};
}

// ---- the files

// The sources of the lightmaps and the faces of the captures: written to be looked at, never read.
bool isForEyes(std::string_view name) {
  return name.ends_with(".exr") && (name.starts_with("lightmap-") || name.starts_with("capture-"));
}

class FolderWriter {
public:
  explicit FolderWriter(fs::path folder) : m_folder(std::move(folder)) {}
  void image(const std::string& name, const base::Image& image, const base::WriteOptions& options = {}) {
    base::writeImage(m_folder / name, image, options);
    list(name);
  }
  void image8(const std::string& name, const base::Image8& image) {
    base::writeImage8(m_folder / name, image);
    list(name);
  }
  void bytes(const std::string& name, std::span<const std::byte> bytes) {
    base::writeBytes(m_folder / name, bytes);
    list(name);
  }
  const Json& files() const { return m_files; }

private:
  void list(const std::string& name) {
    m_files[name] = {{"bytes", fs::file_size(m_folder / name)}, {"hash", hashOfFile(m_folder / name)}};
  }
  fs::path m_folder;
  Json m_files = Json::object();
};

void writeInto(const fs::path& folder, const BakedLight& baked) {
  FolderWriter writer(folder);
  for (std::size_t p = 0; p < baked.halfPages.size(); ++p) {
    if (p < baked.sources.size())
      writer.image(fmt::format("lightmap-{}.exr", p), baked.sources[p],
                   {.channelNames = {"R", "G", "B", "L0", "L1.x", "L1.y", "L1.z", "N.x", "N.y", "N.z"}});
    writer.image(fmt::format("highend-{}.exr", p), widened(baked.halfPages[p]), {.channelNames = {}, .half = true});
    writer.image8(fmt::format("mobile-{}.png", p), baked.lqPages[p]);
    if (baked.sunMask.empty()) continue;
    writer.image8(fmt::format("sun-mask-{}.png", p), baked.sunMask[p]);
    writer.image8(fmt::format("sun-field-{}.png", p), baked.sunField[p]);
  }
  writer.bytes("objects.bin", objectBytes(baked));
  Json captures = Json::array();
  for (std::size_t k = 0; k < baked.captures.size(); ++k) {
    const Capture& capture = baked.captures[k];
    writer.image(fmt::format("capture-{}.exr", k), facesOf(capture.light->prefiltered),
                 {.channelNames = {}, .half = true});
    writer.bytes(fmt::format("capture-{}.bin", k), lighting::toBytes(*capture.light));
    captures.push_back({{"position", toJson(capture.position)},
                        {"boxLower", toJson(capture.boxLower)},
                        {"boxUpper", toJson(capture.boxUpper)},
                        {"radius", capture.radius},
                        {"averageBrightness", capture.averageBrightness()}});
  }
  const BakeFigures& f = baked.figures;
  const Json manifest = {{"format", kFormat},
                         {"version", kVersion},
                         {"scene", baked.scene},
                         {"settings", baked.settings},
                         {"hashes",
                          {{"geometry", baked.hashes.geometry},
                           {"materials", baked.hashes.materials},
                           {"lights", baked.hashes.lights},
                           {"sky", baked.hashes.sky}}},
                         {"localLights", baked.localLights == LocalLights::isStatic ? "static" : "stationary"},
                         {"astc", baked.astc},
                         {"pageSide", baked.pageSide},
                         {"pages", baked.halfPages.size()},
                         {"hasSun", !baked.sunMask.empty()},
                         {"transitionScale", baked.transitionScale},
                         {"captures", captures},
                         {"figures",
                          {{"texels", f.texels},
                           {"samplesPerTexel", f.samplesPerTexel},
                           {"errorMedian", f.errorMedian},
                           {"errorWorst", f.errorWorst},
                           {"shareWithinError", f.shareWithinError},
                           {"quantizedError", f.quantizedError},
                           {"storedError", f.storedError},
                           {"colorDb", f.colorDb},
                           {"directionDb", f.directionDb}}},
                         {"files", writer.files()}};
  base::writeText(folder / kManifestFile, manifest.dump(2) + "\n");
}

// Removed when it goes out of scope, unless it has taken its place.
struct TemporaryFolder {
  fs::path path;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
};

void requireFile(const fs::path& folder, const std::string& name, const Json& files) {
  const fs::path file = folder / name;
  const auto entry = files.find(name);
  if (entry == files.end()) throw base::fileError((folder / kManifestFile).string(), name, "is not listed");
  const std::uintmax_t bytes = base::regularFileSize(file), wanted = entry->at("bytes").get<std::uintmax_t>();
  if (bytes != wanted)
    throw base::fileError(file.string(), "",
                          fmt::format("has {} bytes, but {} in the manifest: it is {}", bytes, wanted,
                                      bytes < wanted ? "truncated" : "another file"));
  if (hashOfFile(file) != entry->at("hash").get<std::string>())
    throw base::fileError(file.string(), "", "does not match its hash in the manifest: it has changed");
}

void requireSize(const fs::path& file, int width, int height, int channels, int wantedSide, int halves,
                 int wantedChannels) {
  if (width != wantedSide || height != halves * wantedSide || channels != wantedChannels)
    throw base::fileError(file.string(), "",
                          fmt::format("{} x {} pixels of {} channels, expected {} x {} of {}", width, height, channels,
                                      wantedSide, halves * wantedSide, wantedChannels));
}

std::shared_ptr<const lighting::EnvironmentLight> readCapture(const fs::path& file, std::span<const std::byte> bytes) {
  try {
    return std::make_shared<const lighting::EnvironmentLight>(lighting::environmentLightFromBytes(bytes));
  } catch (const base::Error& error) {
    throw base::fileError(file.string(), error.place(), error.reason());
  }
}

BakedLight read(const fs::path& folder, const Json& manifest) {
  const Json& files = manifest.at("files");
  const auto checked = [&](const std::string& name) {
    requireFile(folder, name, files);
    return folder / name;
  };
  BakedLight baked;
  baked.scene = manifest.at("scene").get<std::string>();
  baked.settings = manifest.at("settings").get<std::string>();
  baked.astc = manifest.at("astc").get<std::string>();
  const Json& hashes = manifest.at("hashes");
  const auto hash = [&](const char* part) { return hashes.at(part).get<std::string>(); };
  baked.hashes = {hash("geometry"), hash("materials"), hash("lights"), hash("sky")};
  baked.localLights =
      manifest.at("localLights").get<std::string>() == "static" ? LocalLights::isStatic : LocalLights::isStationary;
  baked.pageSide = manifest.at("pageSide").get<int>();
  baked.transitionScale = manifest.at("transitionScale").get<float>();
  const auto pages = manifest.at("pages").get<std::size_t>();
  const bool hasSun = manifest.at("hasSun").get<bool>();
  const std::size_t captures = manifest.at("captures").size();
  if (baked.pageSide < 1 || baked.pageSide > base::kMaxImageSide / 2 || pages > kMaxPages || captures > kMaxCaptures ||
      !(baked.transitionScale > 0))
    throw base::fileError((folder / kManifestFile).string(), "", "has sizes out of range");
  const int side = baked.pageSide;
  for (std::size_t p = 0; p < pages; ++p) {
    const auto readPage = [&](const std::string& name, int halves, int channels) {
      const fs::path file = checked(name);
      base::Image8 image = base::readImage8(file, channels);
      requireSize(file, image.width, image.height, image.channels, side, halves, channels);
      return image;
    };
    const fs::path highend = checked(fmt::format("highend-{}.exr", p));
    const auto& page = baked.halfPages.emplace_back(narrowed(base::readImage(highend)));
    requireSize(highend, page.width, page.height, page.channels, side, 2, 4);
    baked.lqPages.push_back(readPage(fmt::format("mobile-{}.png", p), 2, 4));
    if (!hasSun) continue;
    baked.sunMask.push_back(readPage(fmt::format("sun-mask-{}.png", p), 1, 1));
    baked.sunField.push_back(readPage(fmt::format("sun-field-{}.png", p), 1, 1));
  }
  readObjects(checked("objects.bin"), captures, baked);
  for (std::size_t k = 0; k < captures; ++k) {
    const Json& entry = manifest.at("captures").at(k);
    const fs::path file = checked(fmt::format("capture-{}.bin", k));
    const std::vector<std::byte> bytes = base::readFile(file);
    baked.captures.push_back({vectorOf(entry.at("position")), vectorOf(entry.at("boxLower")),
                              vectorOf(entry.at("boxUpper")), entry.at("radius").get<float>(),
                              readCapture(file, bytes)});
    const Capture& capture = baked.captures.back();
    if (capture.light->prefiltered.faceSize != baked.captures.front().light->prefiltered.faceSize)
      throw base::fileError(file.string(), "", "has another size than the first capture");
    for (const glm::vec3& v : {capture.position, capture.boxLower, capture.boxUpper, glm::vec3(capture.radius)})
      if (glm::any(glm::isnan(v)) || glm::any(glm::isinf(v)))
        throw base::fileError((folder / kManifestFile).string(), "captures", "has a number that is not finite");
  }
  const Json& f = manifest.at("figures");
  baked.figures = {
      f.at("texels").get<std::uint64_t>(), f.at("samplesPerTexel").get<double>(),  f.at("errorMedian").get<double>(),
      f.at("errorWorst").get<double>(),    f.at("shareWithinError").get<double>(), f.at("quantizedError").get<double>(),
      f.at("storedError").get<double>(),   f.at("colorDb").get<double>(),          f.at("directionDb").get<double>()};
  return baked;
}

// The nearest folder above that is there must take another one.
void requireWritableParent(const fs::path& folder) {
  std::error_code error;
  fs::path above = fs::absolute(folder, error).lexically_normal();
  if (!above.has_filename()) above = above.parent_path(); // it ends with a slash
  do above = above.parent_path();
  while (!fs::exists(above, error) && above.has_relative_path());
  if (!fs::is_directory(above, error)) throw base::fileError(folder.string(), "", above.string() + " is not a folder");
  if (::access(above.c_str(), W_OK) != 0)
    throw base::fileError(folder.string(), "", above.string() + ": " + std::generic_category().message(errno));
}

} // namespace

void requireBakeFolder(const fs::path& folder) {
  std::error_code error;
  requireWritableParent(folder);
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) throw base::fileError(folder.string(), "", "is not a folder");
  if (!fs::is_empty(folder, error) && !holdsOnlyABake(folder))
    throw base::fileError(folder.string(), "",
                          "holds files that no bake wrote, so it is not replaced; give another folder");
}

void writeBaked(const fs::path& folder, const BakedLight& baked) {
  requireBakeFolder(folder);
  const std::string suffix = fmt::format(".{}", ::getpid());
  try {
    const fs::path target = fs::weakly_canonical(fs::absolute(folder)), // what a link leads to
        place = target.has_filename() ? target : target.parent_path();
    TemporaryFolder fresh{place.string() + ".new" + suffix};
    fs::create_directories(fresh.path);
    writeInto(fresh.path, baked);
    TemporaryFolder old;
    if (fs::exists(place)) {
      const fs::path aside = place.string() + ".old" + suffix;
      fs::rename(place, aside);
      std::error_code error;
      fs::rename(fresh.path, place, error);
      if (error) {
        fs::rename(aside, place); // the earlier bake stays
        throw fs::filesystem_error("rename", error);
      }
      old.path = aside;
    } else {
      fs::rename(fresh.path, place);
    }
    fresh.path.clear();
  } catch (const fs::filesystem_error& error) {
    throw base::fileError(folder.string(), "", error.code().message());
  }
}

bool isWhole(const fs::path& folder) {
  try {
    const Json manifest = Json::parse(base::readText(folder / kManifestFile, kMaxManifestBytes));
    const Json& files = manifest.at("files");
    for (const auto& [name, entry] : files.items())
      if (!isForEyes(name)) requireFile(folder, name, files);
    return true;
  } catch (const std::exception&) { // readBaked() says what it is
    return false;
  }
}

BakedLight readBaked(const fs::path& folder) {
  const fs::path file = folder / kManifestFile;
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw base::fileError(folder.string(), "", "is not a folder of baked light; 'parity bake' makes one");
  const std::string text = base::readText(file, kMaxManifestBytes);
  try {
    const Json manifest = Json::parse(text);
    if (!manifest.is_object() || manifest.value("format", "") != kFormat)
      throw base::fileError(file.string(), "", "is not the manifest of a bake");
    if (manifest.at("version").get<int>() != kVersion)
      throw base::fileError(
          file.string(), "version",
          fmt::format("is {}, but this program reads {}; bake again", manifest.at("version").dump(), kVersion));
    return read(folder, manifest);
  } catch (const Json::exception& problem) {
    throw base::fileError(file.string(), "", "is damaged: " + base::wordsOf(problem));
  }
}

} // namespace parity::bake
