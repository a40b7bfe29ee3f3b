// What fuzzing begins with loads; its corpus (what once did harm, and inputs that reach far into the loader) loads or
// is refused, at once and in bounded memory.
#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "base/file.h"
#include "fuzz/environment_seeds.h"
#include "fuzz/gltf_mutator.h"
#include "fuzz/gltf_seeds.h"
#include "fuzz/image_seeds.h"
#include "fuzz/inputs.h"

namespace parity::tests {
namespace {

namespace fs = std::filesystem;
using Load = InputResult (*)(const InputFolder&, std::span<const std::byte>);

constexpr double kMaxSeconds = 10;
constexpr long kMaxMiB = 2048;

InputResult loadInTime(Load load, const std::string& name, std::span<const std::byte> bytes) {
  const InputFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const InputResult result = load(folder, bytes);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_EQ(result.fault, "") << name;
  EXPECT_LT(seconds.count(), kMaxSeconds) << name;
  EXPECT_LT(usage.ru_maxrss / 1024, kMaxMiB) << name;
  return result;
}

void expectSeedsLoad(Load load, const std::map<std::string, std::vector<std::byte>>& seeds) {
  for (const auto& [name, bytes] : seeds) {
    const InputResult result = loadInTime(load, name, bytes);
    EXPECT_FALSE(result.isRefused) << name << ": " << result.reason;
  }
}

void expectCorpusIsSurvived(Load load, const std::string& folder) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PARITY_SOURCE_DIR) / "tests/fuzz/corpus" / folder)) {
    EXPECT_LT(entry.file_size(), 16384u) << entry.path() << ": reduce it";
    loadInTime(load, entry.path().filename().string(), base::readFile(entry.path()));
    ++files;
  }
  EXPECT_GT(files, 0u);
}

TEST(FuzzSeeds, EveryGltfFileLoads) { expectSeedsLoad(loadGltfBytes, makeGltfSeeds()); }

TEST(FuzzSeeds, EveryEnvironmentLoads) { expectSeedsLoad(loadEnvironmentBytes, makeEnvironmentSeeds()); }

// As every kind of image, but that floats are no ids.
TEST(FuzzSeeds, EveryImageLoads) {
  for (const auto& [name, bytes] : makeImageSeeds()) {
    const InputResult result = loadInTime(loadImageBytes, name, bytes);
    EXPECT_TRUE(!result.isRefused || result.reason.find("holds no unsigned integers") != std::string::npos)
        << name << ": " << result.reason;
  }
}

TEST(FuzzCorpus, GltfFilesLoadOrAreRefused) { expectCorpusIsSurvived(loadGltfBytes, "gltf"); }

TEST(FuzzCorpus, ImagesLoadOrAreRefused) { expectCorpusIsSurvived(loadImageBytes, "image"); }

TEST(FuzzCorpus, EnvironmentsLoadOrAreRefused) { expectCorpusIsSurvived(loadEnvironmentBytes, "environment"); }

// Stands in for libFuzzer's own: adds one to a byte.
std::size_t mutateOneByte(std::uint8_t* data, std::size_t size, std::size_t) {
  if (size > 0) ++data[size / 2];
  return size;
}

TEST(GltfMutator, MakesFilesThatGetPastTheContainerAndDependOnTheSeedAlone) {
  const InputFolder folder;
  std::size_t refused = 0, beyondJson = 0, tried = 0;
  for (const auto& [name, bytes] : makeGltfSeeds())
    for (unsigned seed = 0; seed < 40; ++seed) {
      std::vector<std::uint8_t> data(65536), again(65536);
      std::transform(bytes.begin(), bytes.end(), data.begin(),
                     [](std::byte b) { return static_cast<std::uint8_t>(b); });
      again = data;
      data.resize(mutateGltf(data.data(), bytes.size(), data.size(), seed, mutateOneByte));
      again.resize(mutateGltf(again.data(), bytes.size(), again.size(), seed, mutateOneByte));
      ASSERT_EQ(data, again) << name << " " << seed;
      const InputResult result = loadGltfBytes(folder, std::as_bytes(std::span(data)));
      EXPECT_EQ(result.fault, "") << name << " " << seed;
      ++tried;
      refused += result.isRefused;
      beyondJson += !result.isRefused || result.reason.find(": /") != std::string::npos;
    }
  EXPECT_GT(refused, tried / 10);
  EXPECT_LT(refused, tried * 9 / 10);
  EXPECT_GT(beyondJson, tried * 8 / 10) << "most are whole files with one thing wrong";
}

} // namespace
} // namespace parity::tests
