// Reading and writing whole files: what is refused, and that nothing is left half-written.
#include "base/file.h"
#include "base/temporary_name.h"
#include "base/write_pieces.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "expect_error.h"
#include "file_size_limit.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

namespace fs = std::filesystem;

class Environment {
public:
  Environment(const char* name, const char* value) : m_name(name) {
    if (const char* before = std::getenv(name)) m_before = before, m_was = true;
    value ? setenv(name, value, 1) : unsetenv(name);
  }
  ~Environment() { m_was ? setenv(m_name, m_before.c_str(), 1) : unsetenv(m_name); }

private:
  const char* m_name;
  std::string m_before;
  bool m_was = false;
};

TEST(ReadFile, ReturnsWhatWasWritten) {
  const TempFolder folder;
  const std::string text("line\nzero \0 byte", 16);
  writeText(folder / "a.txt", text);
  EXPECT_EQ(readText(folder / "a.txt"), text);
  const std::vector<std::byte> bytes = readFile(folder / "a.txt");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), text);
  EXPECT_EQ(regularFileSize(folder / "a.txt"), text.size());
}

TEST(ReadFile, TakesAnEmptyFile) {
  const TempFolder folder;
  writeText(folder / "empty", "");
  EXPECT_TRUE(readFile(folder / "empty").empty());
}

TEST(ReadFile, RefusesAMissingFile) {
  const TempFolder folder;
  expectError([&] { readFile(folder / "no.gltf"); }, "no.gltf", "does not exist");
  writeText(folder / "file", "x");
  expectError([&] { readFile(folder / "file" / "below"); }, "below", "");
}

TEST(ReadFile, RefusesAFolder) {
  const TempFolder folder;
  expectError([&] { readFile(folder.path()); }, folder.path().string(), "is a folder");
  expectError([&] { readText(folder.path()); }, folder.path().string(), "is a folder");
}

TEST(ReadFile, RefusesDevicesAndPipesWithoutWaitingOnThem) {
  const TempFolder folder;
  expectError([] { readFile("/dev/zero"); }, "/dev/zero", "is not a regular file");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expectError([&] { readFile(folder / "pipe"); }, "pipe", "is not a regular file");
}

TEST(ReadFile, RefusesMoreBytesThanTheLimitBeforeItTakesMemory) {
  const TempFolder folder;
  writeText(folder / "ten", "0123456789");
  EXPECT_EQ(readText(folder / "ten", 10).size(), 10u);
  expectError([&] { readText(folder / "ten", 9); }, "ten", "has 10 bytes; the limit is 9");
  // Sparse: 1 TiB that the disk does not hold, and no memory could.
  std::ofstream(folder / "vast") << "x";
  fs::resize_file(folder / "vast", std::uintmax_t{1} << 40);
  expectError([&] { readFile(folder / "vast"); }, "vast", "the limit is");
}

TEST(WriteAtomically, KeepsTheExtensionAndTheFolderForTheTemporaryName) {
  const TempFolder folder;
  fs::path temporary;
  writeAtomically(folder / "image.exr", [&](const fs::path& path) {
    temporary = path;
    std::ofstream(path) << "new";
    EXPECT_FALSE(fs::exists(folder / "image.exr"));
  });
  EXPECT_EQ(temporary.extension(), ".exr");
  EXPECT_EQ(temporary.parent_path(), folder.path());
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"image.exr"});
}

TEST(WriteAtomically, LeavesTheOldFileWhereWritingFails) {
  const TempFolder folder;
  writeText(folder / "a.json", "old");
  EXPECT_THROW(writeAtomically(folder / "a.json",
                               [](const fs::path& path) {
                                 std::ofstream(path) << "half";
                                 throw std::logic_error("lost");
                               }),
               std::logic_error);
  EXPECT_EQ(readText(folder / "a.json"), "old");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.json"});
}

TEST(WriteAtomically, RefusesAWriterThatWroteNothing) {
  const TempFolder folder;
  expectError([&] { writeAtomically(folder / "a", [](const fs::path&) {}); }, "/a", "cannot be written");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(WriteText, LeavesNothingOnAFullDisk) {
  const TempFolder folder;
  writeText(folder / "kept", "old");
  const FileSizeLimit limit(100);
  expectError([&] { writeText(folder / "new", std::string(1000, 'x')); }, (folder / "new").string(), "File too large");
  expectError([&] { writeText(folder / "kept", std::string(1000, 'x')); }, (folder / "kept").string(), "cannot be");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"kept"});
  EXPECT_EQ(readText(folder / "kept"), "old");
}

TEST(WriteText, MakesTheFoldersAbove) {
  const TempFolder folder;
  writeText(folder / "a/b/c.txt", "deep");
  EXPECT_EQ(readText(folder / "a/b/c.txt"), "deep");
  expectError([&] { writeText(folder / "a/b/c.txt/d", "x"); }, "c.txt/d", "folder");
}

TEST(WriteText, WritesBesideTheProgramWithABareName) {
  const TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_NO_THROW(writeText("bare.txt", "x"));
  fs::current_path(before);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"bare.txt"});
}

TEST(WriteText, DoesNotReplaceFoldersOrDevices) {
  const TempFolder folder;
  fs::create_directory(folder / "sub");
  expectError([&] { writeText(folder / "sub", "x"); }, "sub", "is a folder");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expectError([&] { writeText(folder / "pipe", "x"); }, "pipe", "is not a regular file");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  expectError([&] { writeText(folder.path() / "", "x"); }, folder.path().string(), "");
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"pipe", "sub"}));
}

TEST(WriteText, FollowsALinkInsteadOfReplacingIt) {
  const TempFolder folder;
  writeText(folder / "real", "old");
  fs::create_symlink("real", folder / "link");
  writeText(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readText(folder / "real"), "new");
}

TEST(WriteText, TakesManyWritersOfOneFile) {
  const TempFolder folder;
  std::vector<std::thread> writers;
  for (int i = 0; i < 8; ++i)
    writers.emplace_back([&, i] { writeText(folder / "one", std::string(10000, static_cast<char>('a' + i))); });
  for (std::thread& writer : writers) writer.join();
  const std::string text = readText(folder / "one");
  EXPECT_EQ(text, std::string(10000, text[0])); // whose it is does not matter; that it is one's does
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"one"});
}

TEST(WriteOnce, TheFirstOfManyWritersStaysAndNothingElse) {
  const TempFolder folder;
  std::vector<std::thread> writers;
  std::atomic<int> written = 0;
  for (int i = 0; i < 8; ++i)
    writers.emplace_back([&, i] {
      const std::string text(10000, static_cast<char>('a' + i));
      if (writeOnce(folder / "units/one", std::as_bytes(std::span{text}))) written += 1 + i * 100;
    });
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(written % 100, 1) << "one alone wrote it";
  EXPECT_EQ(readText(folder / "units/one"), std::string(10000, static_cast<char>('a' + written / 100)));
  EXPECT_FALSE(writeOnce(folder / "units/one", {}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "units"), {}), 1);
}

TEST(ReplaceDurably, ReplacesAndLeavesNothingElse) {
  const TempFolder folder;
  for (const std::string text : {"one", "two"}) {
    replaceDurably(folder / "units/a", std::as_bytes(std::span{text}));
    EXPECT_EQ(readText(folder / "units/a"), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "units"), {}), 1);
}

TEST(WriteOnce, LeavesNothingOnAFullDisk) {
  const TempFolder folder;
  const FileSizeLimit limit(100);
  const std::string text(1000, 'x');
  expectError([&] { writeOnce(folder / "new", std::as_bytes(std::span{text})); }, (folder / "new").string(),
              "File too large");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(WritePieces, ArePutOneBehindTheOther) {
  const TempFolder folder;
  writePieces(folder / "a.txt", [](const TextSink& sink) { sink("one "), sink(""), sink("two"); });
  EXPECT_EQ(readText(folder / "a.txt"), "one two");
}

TEST(WritePieces, LeaveTheOldFileWhereOneFails) {
  const TempFolder folder;
  writeText(folder / "a.txt", "old");
  const auto fail = [](const TextSink& sink) {
    sink("new");
    throw std::runtime_error("the next piece");
  };
  EXPECT_THROW(writePieces(folder / "a.txt", fail), std::runtime_error);
  EXPECT_EQ(readText(folder / "a.txt"), "old");
  const FileSizeLimit limit(100);
  expectError([&] { writePieces(folder / "a.txt", [](const TextSink& sink) { sink(std::string(1000, 'x')); }); },
              "a.txt: cannot be written", "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(DefaultCacheFolder, FollowsTheDesktopSpecification) {
  const Environment home("HOME", "/home/someone");
  {
    const Environment cache("XDG_CACHE_HOME", "/var/fast");
    EXPECT_EQ(defaultCacheFolder(), "/var/fast/parity");
  }
  {
    const Environment relative("XDG_CACHE_HOME", "relative");
    EXPECT_EQ(defaultCacheFolder(), "/home/someone/.cache/parity");
  }
  const Environment none("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(defaultCacheFolder(), "/home/someone/.cache/parity");
  const Environment homeless("HOME", nullptr);
  expectError([] { defaultCacheFolder(); }, "cache", "HOME");
}

TEST(TemporaryName, IsKnownAgainAndNoOtherIs) {
  const std::string name = temporaryNameOf("0-scene_0-auto_flip.png");
  EXPECT_TRUE(name.starts_with(".0-scene_0-auto_flip.") && name.ends_with(".png")) << name;
  EXPECT_NE(temporaryNameOf("a.png"), temporaryNameOf("a.png"));
  EXPECT_EQ(ownNameOf(name), "0-scene_0-auto_flip.png");
  EXPECT_EQ(ownNameOf(temporaryNameOf("report.json")), "report.json");
  EXPECT_EQ(ownNameOf(temporaryNameOf("a.b.c.tar")), "a.b.c.tar");
  EXPECT_EQ(ownNameOf(temporaryNameOf("plain")), "plain");
  for (const char* other : {"a.png", ".a.png", ".a.12.png", ".a.12-.png", ".a.-3.png", ".a.1x-3.png", "a.12-3.png",
                            ".12-3.png", "", ".", ".."})
    EXPECT_EQ(ownNameOf(other), std::nullopt) << other;
}

} // namespace
} // namespace parity::base
