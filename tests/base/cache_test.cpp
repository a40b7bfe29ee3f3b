// The blob cache: what is stored comes back or is a miss, never something else, and the folder stays within its bound.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cache.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/temp_folder.h"

namespace parity::base {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

// Content that tells itself apart from that of any other seed.
Bytes makeBytes(std::size_t count, unsigned seed) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>((i * 31 + seed * 7 + (i >> 8)) & 255);
  return bytes;
}

std::string hashKeyOf(std::string_view text) { return Hasher().add(text).hex(); }

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

std::uintmax_t bytesIn(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::path& file : filesIn(folder)) sum += fs::file_size(file);
  return sum;
}

// The only file in the folder that `store` makes.
fs::path storeAlone(const fs::path& folder, const Cache& cache, const std::string& key, const Bytes& bytes) {
  cache.store(key, bytes);
  const std::vector<fs::path> files = filesIn(folder);
  EXPECT_EQ(files.size(), 1u);
  return files.at(0);
}

void age(const fs::path& file, int hours) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
}

TEST(Cache, ReturnsWhatWasStoredUnderThatKeyAlone) {
  const TempFolder temp;
  const Cache cache(temp.path() / "deep" / "cache");
  EXPECT_TRUE(cache.enabled());
  EXPECT_FALSE(cache.find(hashKeyOf("a")));
  cache.store(hashKeyOf("a"), makeBytes(1000, 1));
  cache.store(hashKeyOf("b"), makeBytes(2000, 2));
  cache.store(hashKeyOf("empty"), {});
  EXPECT_EQ(cache.find(hashKeyOf("a")), makeBytes(1000, 1));
  EXPECT_EQ(cache.find(hashKeyOf("b")), makeBytes(2000, 2));
  EXPECT_EQ(cache.find(hashKeyOf("empty")), Bytes{});
  EXPECT_FALSE(cache.find(hashKeyOf("c")));
  cache.store(hashKeyOf("a"), makeBytes(10, 3)); // replaced
  EXPECT_EQ(Cache(temp.path() / "deep" / "cache").find(hashKeyOf("a")), makeBytes(10, 3));
}

TEST(Cache, IsEmptyUntilSomethingIsStored) {
  const TempFolder folder;
  EXPECT_TRUE(Cache::disabled().isEmpty());
  EXPECT_TRUE(Cache(folder.path()).isEmpty());
  const Cache cache(folder.path() / "new");
  EXPECT_TRUE(cache.isEmpty());
  ASSERT_TRUE(cache.store(hashKeyOf("a"), makeBytes(10, 1)));
  EXPECT_FALSE(cache.isEmpty());
  cache.clear();
  EXPECT_TRUE(cache.isEmpty());
}

TEST(Cache, DisabledFindsAndWritesNothing) {
  const Cache cache = Cache::disabled();
  EXPECT_FALSE(cache.enabled());
  cache.store(hashKeyOf("a"), makeBytes(10, 1));
  EXPECT_FALSE(cache.find(hashKeyOf("a")));
}

TEST(Cache, EveryDamagedByteIsAMissAndTheEntryIsLeftAlone) {
  const TempFolder temp;
  const Cache cache(temp.path());
  const std::string key = hashKeyOf("a");
  const Bytes content = makeBytes(60, 1);
  const Bytes whole = readFile(storeAlone(temp.path(), cache, key, content));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const fs::path file = storeAlone(temp.path(), cache, key, content);
    Bytes damaged = whole;
    damaged[i] ^= std::byte{1};
    writeBytes(file, damaged);
    EXPECT_FALSE(cache.find(key)) << "byte " << i;
    EXPECT_EQ(readFile(file), damaged) << "byte " << i;
  }
}

TEST(Cache, TruncatedAndOverlongEntriesAreMissesUntilTheyAreStoredAgain) {
  const TempFolder temp;
  const Cache cache(temp.path());
  const std::string key = hashKeyOf("a");
  const Bytes content = makeBytes(60, 1);
  const Bytes whole = readFile(storeAlone(temp.path(), cache, key, content));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{47}, std::size_t{48}, whole.size() - 1, whole.size() + 1}) {
    const fs::path file = storeAlone(temp.path(), cache, key, content);
    Bytes damaged = whole;
    damaged.resize(size);
    writeBytes(file, damaged);
    EXPECT_FALSE(cache.find(key)) << size << " bytes";
    EXPECT_EQ(readFile(file), damaged) << size << " bytes";
  }
  cache.store(key, content);
  EXPECT_EQ(cache.find(key), content);
}

TEST(Cache, AnEntryOfAnotherKeyIsAMiss) {
  const TempFolder temp;
  const Cache cache(temp.path());
  const fs::path a = storeAlone(temp.path(), cache, "a", makeBytes(60, 1));
  fs::rename(a, a.parent_path() / ("b" + a.extension().string()));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_EQ(filesIn(temp.path()).size(), 1u);
  cache.store("b", makeBytes(20, 2));
  EXPECT_EQ(cache.find("b"), makeBytes(20, 2));
}

TEST(Cache, RemovesWhatWasUsedLongestAgo) {
  const TempFolder temp;
  const Cache cache(temp.path(), 3500); // three entries of 1048 bytes
  for (const char* key : {"a", "b", "c"}) cache.store(key, makeBytes(1000, 1));
  int hours = 10;
  for (const char* key : {"a", "b", "c"}) age(temp.path() / (std::string(key) + ".parity-blob"), hours--);
  ASSERT_TRUE(cache.find("a")); // now used last
  cache.store("d", makeBytes(1000, 4));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_TRUE(cache.find("a"));
  EXPECT_TRUE(cache.find("c"));
  EXPECT_TRUE(cache.find("d"));
  EXPECT_LE(bytesIn(temp.path()), 3500u);
}

TEST(Cache, StaysWithinItsBoundWhateverIsStored) {
  const TempFolder temp;
  const Cache cache(temp.path(), 5000);
  for (unsigned i = 0; i < 40; ++i) {
    cache.store("key" + std::to_string(i), makeBytes(100 + 113 * i % 4000, i));
    EXPECT_LE(bytesIn(temp.path()), 5000u);
    EXPECT_TRUE(cache.find("key" + std::to_string(i))) << "the newest entry stays";
  }
  const auto before = filesIn(temp.path()).size();
  cache.store("large", makeBytes(5000, 1)); // with its header above the bound
  EXPECT_FALSE(cache.find("large"));
  EXPECT_EQ(filesIn(temp.path()).size(), before);
  cache.store("fits", makeBytes(5000 - 48, 1));
  EXPECT_TRUE(cache.find("fits"));
}

TEST(Cache, NeverTouchesFilesOfOthers) {
  const TempFolder temp;
  writeText(temp.path() / "thesis.txt", std::string(100000, 'x'));
  age(temp.path() / "thesis.txt", 1000);
  const Cache cache(temp.path(), 2000);
  for (int i = 0; i < 5; ++i) cache.store("key" + std::to_string(i), makeBytes(1000, 1));
  EXPECT_EQ(fs::file_size(temp.path() / "thesis.txt"), 100000u);
}

TEST(Cache, TemporaryFilesOfAKilledProcessAreRemovedInTheEnd) {
  const TempFolder temp;
  const fs::path left = temp.path() / ".a.999-0.parity-blob"; // as base::writeAtomically names them
  writeText(left, std::string(1500, 'x'));
  age(left, 5);
  const Cache cache(temp.path(), 2000);
  cache.store("b", makeBytes(1000, 1));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(cache.find("b"));
}

TEST(Cache, MayBeDeletedAtAnyTime) {
  const TempFolder temp;
  const Cache cache(temp.path() / "cache");
  cache.store("a", makeBytes(10, 1));
  fs::remove_all(temp.path() / "cache");
  EXPECT_FALSE(cache.find("a"));
  cache.store("a", makeBytes(10, 1));
  EXPECT_TRUE(cache.find("a"));
}

TEST(Cache, AFolderThatCannotBeWrittenIsOneWarningAndNoError) {
  const TempFolder temp;
  writeText(temp.path() / "file", "not a folder");
  const Cache cache(temp.path() / "file");
  testing::internal::CaptureStderr();
  cache.store("a", makeBytes(10, 1));
  cache.store("b", makeBytes(10, 1));
  EXPECT_FALSE(cache.find("a"));
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
  EXPECT_TRUE(log.starts_with("warning: cache: ")) << log;
}

TEST(Cache, DescribesItsEntriesByKindAndRemovesThemAlone) {
  const TempFolder temp;
  const Cache cache(temp.path() / "cache");
  EXPECT_EQ(cache.describe().entries, 0u);
  EXPECT_EQ(cache.clear().entries, 0u);
  cache.store("lut-1", makeBytes(100, 1));
  cache.store("lut-2", makeBytes(200, 2));
  cache.store("plain", makeBytes(10, 3));
  writeText(temp.path() / "cache" / ".lut-3.999-0.parity-blob", "left by a killed process");
  writeText(temp.path() / "cache" / "notes.txt", "the user's own");
  const CacheContents contents = cache.describe();
  ASSERT_EQ(contents.kinds.size(), 2u);
  EXPECT_EQ(contents.kinds[0].name, "lut");
  EXPECT_EQ(contents.kinds[0].entries, 2u);
  EXPECT_EQ(contents.kinds[0].bytes, 100u + 200u + 2 * 48u);
  EXPECT_EQ(contents.kinds[1].name, "other");
  EXPECT_EQ(contents.kinds[1].bytes, 10u + 48u + 24u);
  EXPECT_EQ(contents.bytes, bytesIn(temp.path() / "cache") - 14);
  EXPECT_EQ(cache.clear().bytes, contents.bytes);
  EXPECT_EQ(filesIn(temp.path() / "cache"), std::vector<fs::path>{temp.path() / "cache" / "notes.txt"});
  writeText(temp.path() / "file", "no folder");
  EXPECT_THROW(Cache(temp.path() / "file").describe(), Error);
}

// Each process stores and finds the same few keys in a cache too small for all of them: every hit is whole and right.
TEST(Cache, ServesSeveralProcessesAtOnce) {
  const TempFolder temp;
  constexpr int kProcesses = 4, kRounds = 150;
  std::vector<pid_t> children;
  for (int p = 0; p < kProcesses; ++p) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const Cache cache(temp.path(), 60000);
      int hits = 0;
      for (int i = 0; i < kRounds; ++i) {
        const unsigned seed =
            static_cast<unsigned>(i / 3 * (p + 1)) % 6; // each thrice, so that even one alone finds some
        const std::string key = "key" + std::to_string(seed);
        if (const auto found = cache.find(key)) {
          if (*found != makeBytes(20000, seed)) ::_exit(1);
          ++hits;
        } else {
          cache.store(key, makeBytes(20000, seed));
        }
      }
      ::_exit(hits > 0 ? 0 : 2);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  EXPECT_LE(bytesIn(temp.path()), 60000u + kProcesses * 20048u); // a store may be under way beside each eviction
  const Cache cache(temp.path(), 60000);
  cache.store("last", makeBytes(100, 9));
  EXPECT_LE(bytesIn(temp.path()), 60000u);
}

} // namespace
} // namespace parity::base
