// A bake is read as it was written, bit for bit, and never half of it.
#include "bake/baked_folder.h"

#include <gtest/gtest.h>

#include <random>

#include <cstring>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/file_size_limit.h"
#include "base/temp_folder.h"
#include "lighting/environment/cube.h"
#include "shading/half.h"

namespace parity::bake {
namespace {

namespace fs = std::filesystem;
using parity::base::FileSizeLimit;
using parity::base::TempFolder;

// Every member differs from its default, and from its like.
BakedLight makeBaked() {
  BakedLight baked;
  baked.scene = "a \"scene\"";
  baked.settings = "few texels";
  baked.astc = "6x6";
  baked.hashes = {"g", "m", "l", "s"};
  baked.localLights = LocalLights::isStationary;
  baked.pageSide = 8;
  baked.uvs.corners = {{0, 0.1f}, {1, 0.2f}, {0.5f, 1 / 3.f}};
  baked.uvs.places = {{.firstCorner = 0, .offset = {0.25f, 0.125f}, .page = 1, .capture = 1}, {.page = -1}};
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-70000, 70000);
  for (int page = 0; page < 2; ++page) {
    base::Image source(8, 8, 10);
    for (float& value : source.pixels) value = uniform(random);
    baked.sources.push_back(source);
    base::BasicImage<std::uint16_t> halves(8, 16, 4);
    for (std::uint16_t& value : halves.pixels) // all finite ones, zeros of both signs and denormals among them
      do value = static_cast<std::uint16_t>(random());
      while ((value & 0x7c00) == 0x7c00);
    baked.halfPages.push_back(halves);
    base::Image8 mobile(8, 16, 4), mask(8, 8, 1), field(8, 8, 1);
    for (auto* image : {&mobile, &mask, &field})
      for (std::uint8_t& value : image->pixels) value = static_cast<std::uint8_t>(random());
    baked.lqPages.push_back(mobile);
    baked.sunMask.push_back(mask);
    baked.sunField.push_back(field);
  }
  for (int i = 0; i < 8; ++i) baked.lqScales.emplace_back(i, 0.1f * static_cast<float>(i), -1, 1e-30f);
  baked.transitionScale = 0.3f;
  for (int k = 0; k < 2; ++k) {
    std::vector<glm::vec4> texels(std::size_t{6} * 32 * 32, glm::vec4(1, 2, static_cast<float>(k), 1));
    texels[7].x = 500;
    baked.captures.push_back({glm::vec3(0.1f, k, 3), glm::vec3(-1, -2, -3), glm::vec3(4, 5, 1 / 7.f), 2.7f,
                              std::make_shared<const lighting::EnvironmentLight>(
                                  lighting::makeEnvironmentLight(texels, {.faceSize = 32, .sampleCount = 4}))});
  }
  baked.figures = {12345678901, 512.25, 0.01, 0.2, 0.99, 0.003, 0.04, 41.5, 38.25};
  return baked;
}

template <typename T> bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
template <typename T>
bool sameImages(const std::vector<base::BasicImage<T>>& a, const std::vector<base::BasicImage<T>>& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.width == y.width && x.height == y.height && x.channels == y.channels && sameBits(x.pixels, y.pixels);
  });
}

void expectSame(const BakedLight& a, const BakedLight& b) {
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.settings, b.settings);
  EXPECT_EQ(a.astc, b.astc);
  EXPECT_EQ(a.hashes, b.hashes);
  EXPECT_EQ(a.localLights, b.localLights);
  EXPECT_EQ(a.pageSide, b.pageSide);
  EXPECT_TRUE(sameBits(a.uvs.corners, b.uvs.corners));
  EXPECT_TRUE(sameBits(a.uvs.places, b.uvs.places));
  EXPECT_TRUE(sameImages(a.halfPages, b.halfPages));
  EXPECT_TRUE(sameImages(a.lqPages, b.lqPages));
  EXPECT_TRUE(sameBits(a.lqScales, b.lqScales));
  EXPECT_TRUE(sameImages(a.sunMask, b.sunMask));
  EXPECT_TRUE(sameImages(a.sunField, b.sunField));
  EXPECT_EQ(a.transitionScale, b.transitionScale);
  ASSERT_EQ(a.captures.size(), b.captures.size());
  for (std::size_t k = 0; k < a.captures.size(); ++k) {
    EXPECT_EQ(a.captures[k].position, b.captures[k].position);
    EXPECT_EQ(a.captures[k].boxLower, b.captures[k].boxLower);
    EXPECT_EQ(a.captures[k].boxUpper, b.captures[k].boxUpper);
    EXPECT_EQ(a.captures[k].radius, b.captures[k].radius);
    EXPECT_TRUE(lighting::toBytes(*a.captures[k].light) == lighting::toBytes(*b.captures[k].light));
  }
  const BakeFigures &f = a.figures, &g = b.figures;
  EXPECT_EQ(f.texels, g.texels);
  EXPECT_EQ(f.samplesPerTexel, g.samplesPerTexel);
  EXPECT_EQ(f.errorMedian, g.errorMedian);
  EXPECT_EQ(f.errorWorst, g.errorWorst);
  EXPECT_EQ(f.shareWithinError, g.shareWithinError);
  EXPECT_EQ(f.quantizedError, g.quantizedError);
  EXPECT_EQ(f.storedError, g.storedError);
  EXPECT_EQ(f.colorDb, g.colorDb);
  EXPECT_EQ(f.directionDb, g.directionDb);
}

void expectError(const std::function<void()>& body, const std::string& part) { base::expectError(body, {part}); }

TEST(BakedFolder, IsReadAsItWasWritten) {
  const TempFolder folder;
  const BakedLight baked = makeBaked();
  writeBaked(folder / "below" / "it", baked);
  expectSame(readBaked(folder / "below" / "it"), baked);
  BakedLight without = makeBaked();
  without.sunMask.clear();
  without.sunField.clear();
  without.captures.clear();
  without.localLights = LocalLights::isStatic;
  writeBaked(folder / "below" / "it", without);
  expectSame(readBaked(folder / "below" / "it"), without);
  EXPECT_FALSE(fs::exists(folder / "below" / "it" / "capture-0.bin")) << "of the bake before";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "below"), {}), 1) << "nothing is left beside it";
}

TEST(BakedFolder, EarlierOneStaysWhereTheDiskIsFull) {
  const TempFolder folder;
  const BakedLight baked = makeBaked();
  writeBaked(folder / "bake", baked);
  for (const rlim_t bytes : {10, 1000, 10000, 60000}) {
    const FileSizeLimit full(bytes);
    expectError([&] { writeBaked(folder / "bake", baked); }, "bake");
    expectError([&] { writeBaked(folder / "other", baked); }, "other");
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"bake"}) << bytes;
  }
  expectSame(readBaked(folder / "bake"), baked);
}

TEST(BakedFolder, ReplacesOnlyWhatItsManifestLists) {
  const TempFolder folder;
  requireBakeFolder(folder / "none");
  fs::create_directory(folder / "empty");
  requireBakeFolder(folder / "empty");
  writeBaked(folder / "bake", makeBaked());
  requireBakeFolder(folder / "bake");
  std::ofstream(folder / "bake" / "notes.txt") << "mine";
  expectError([&] { requireBakeFolder(folder / "bake"); }, "that no bake wrote");
  expectError([&] { writeBaked(folder / "bake", makeBaked()); }, "that no bake wrote");
  EXPECT_TRUE(fs::exists(folder / "bake" / "notes.txt"));
  EXPECT_EQ(readBaked(folder / "bake").pageSide, 8) << "what lies beside its files does not matter to reading";
}

// A manifest of honest hashes over objects that are not those of its pages.
TEST(BakedFolder, ObjectsMustFitThePages) {
  const TempFolder folder;
  const auto refused = [&](const std::function<void(BakedLight&)>& change) {
    BakedLight baked = makeBaked();
    change(baked);
    writeBaked(folder / "bake", baked);
    expectError([&] { readBaked(folder / "bake"); }, "objects.bin");
  };
  refused([](BakedLight& baked) { baked.uvs.places[0].page = 2; });
  refused([](BakedLight& baked) { baked.uvs.places[0].firstCorner = 3; });
  refused([](BakedLight& baked) { baked.lqScales.pop_back(); });
}

TEST(BakedFolder, IsWholeWhileAllThatIsReadIsWhatTheManifestLists) {
  const TempFolder temp;
  const fs::path folder = temp / "baked";
  writeBaked(folder, makeBaked());
  EXPECT_TRUE(isWhole(folder));
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool isRead = !name.starts_with("lightmap-") && name != "capture-0.exr" && name != "capture-1.exr";
    fs::rename(file, temp / "aside");
    EXPECT_EQ(isWhole(folder), !isRead) << name << " is missing";
    fs::copy_file(temp / "aside", file);
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(20).put('\x7e').put('\x7d');
    if (name != kManifestFile) {
      EXPECT_EQ(isWhole(folder), !isRead) << name << " is damaged";
    }
    fs::rename(temp / "aside", file);
    EXPECT_TRUE(isWhole(folder));
  }
  EXPECT_FALSE(isWhole(temp / "none"));
}

} // namespace
} // namespace parity::bake
