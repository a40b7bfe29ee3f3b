// The module that holds OpenImageIO: loaded by the first image that needs it and not before, and by one thread only.
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/hash.h"
#include "base/image/color.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
#include "expect_error.h"
#include "exr_writer.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

bool isLoaded(const std::string& library) {
  std::ostringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  if (maps.str().find("libc.so") == std::string::npos) throw std::runtime_error("/proc/self/maps cannot be read");
  return maps.str().find(library) != std::string::npos;
}

// Runs the body in a child of its own, since loading cannot be undone: each test is then the first.
template <typename Body> void inFreshProcess(Body&& body) {
  ASSERT_FALSE(isLoaded("OpenImageIO")) << "loaded by the parent already";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      body();
    } catch (const std::exception& error) { // it must not reach the runner, which would go on with the other tests
      ADD_FAILURE() << error.what();
    }
    std::cout << std::flush;
    std::_Exit(testing::Test::HasFailure() ? 1 : 0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the child failed: " << status;
}

// An OpenEXR file that only the library reads: 300x300, of this value.
std::filesystem::path makeLibrarysFile(const TempFolder& folder, float value) {
  const auto file = folder / "library.exr";
  makeExr(file, {.compression = EXR_COMPRESSION_PXR24, .width = 300, .height = 300, .halves = {false}},
          {std::bit_cast<std::uint32_t>(value)});
  return file;
}

TEST(ImageModule, IsLoadedByTheFirstImageThatNeedsIt) {
  inFreshProcess([] {
    const TempFolder folder;
    const Image image(9, 2, 3, 0.5f); // narrower HDR has no runs: the library reads it
    writeText(folder / "a.txt", Hasher().add("text").hex());
    writeImage(folder / "a.pfm", image); // PFM needs no library
    EXPECT_EQ(readImage(folder / "a.pfm"), image);
    EXPECT_FALSE(isIntegerImage(folder / "a.pfm"));
    EXPECT_EQ(DisplayTransform("raw").apply(image), image);
    EXPECT_NO_THROW(DisplayTransform("sRGB").apply(image));
    expectError([&] { readImage(folder / "none.png"); }, "none.png", "does not exist");
    EXPECT_FALSE(isLoaded("OpenImageIO"));
    EXPECT_FALSE(isLoaded("parity_imageio"));

    for (const char* name : {"a.exr", "a.hdr", "a.png"}) {
      writeImage(folder / name, image);
      readImage(folder / name);
    }
    const auto file = makeLibrarysFile(folder, 0.5f);
    EXPECT_FALSE(isLoaded("OpenImageIO"));
    EXPECT_EQ(readImage(file), Image(300, 300, 3, 0.5f));
    EXPECT_TRUE(isLoaded("OpenImageIO"));
  });
}

TEST(ImageModule, ThrowsErrorsThatAreCaughtOutsideAsSuch) {
  inFreshProcess([] {
    const TempFolder folder;
    writeText(folder / "a.exr", "no image at all");
    expectError([&] { readImage(folder / "a.exr"); }, "a.exr", "cannot be decoded"); // thrown inside the module
    try {
      readImage(folder / "a.exr");
    } catch (const std::runtime_error& error) { // by its base class, too
      EXPECT_NE(dynamic_cast<const Error*>(&error), nullptr);
    }
  });
}

TEST(ImageModule, MayBeUsedFirstByManyThreadsAtOnce) {
  inFreshProcess([] {
    const TempFolder folder;
    const auto file = makeLibrarysFile(folder, 0.25f);
    std::vector<std::thread> threads;
    for (int i = 0; i < 6; ++i) threads.emplace_back([&] { EXPECT_EQ(readImage(file), Image(300, 300, 3, 0.25f)); });
    for (std::thread& thread : threads) thread.join();
  });
}

// How many threads a process has once the library has read an EXR under this limit.
int countThreads(int limit) {
  const TempFolder folder;
  inFreshProcess([&] {
    const auto file = makeLibrarysFile(folder, 0.25f);
    const ThreadLimit threads(limit);
    readImage(file);
    const auto count = std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
    writeText(folder / "count", std::to_string(count));
  });
  return std::stoi(readText(folder / "count"));
}

TEST(ImageModule, TakesTheLimitOfThreadsForTheLibraryToo) {
  if (threadCount() < 2) GTEST_SKIP() << "one core: there is nothing to limit";
  // Some libraries start threads of their own when they are loaded, which then sleep: only the difference tells.
  EXPECT_LT(countThreads(1), countThreads(0));
}

// What a copy of this program in `folder`/bin says to reading its first image there, and whether it could.
std::pair<bool, std::string> runCopy(const TempFolder& folder) {
  const auto program = folder / "bin/program", log = folder / "log";
  const std::string command =
      "'" + program.string() + "' --gtest_filter='*IsLoadedByTheFirstImageThatNeedsIt' > '" + log.string() + "' 2>&1";
  const bool passed = std::system(command.c_str()) == 0;
  return {passed, readText(log)};
}

TEST(ImageModule, IsFoundWhereItMayLieAndItsAbsenceSaysWhatToDo) {
  const TempFolder folder;
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  std::filesystem::create_directories(folder / "bin");
  std::filesystem::create_directories(folder / "lib/parity");
  std::filesystem::copy_file(program, folder / "bin/program");

  const auto [withoutPassed, without] = runCopy(folder);
  EXPECT_FALSE(withoutPassed);
  EXPECT_NE(without.find("parity_imageio.so: not found"), std::string::npos) << without;
  EXPECT_NE(without.find("build the target parity_imageio, or install it"), std::string::npos) << without;

  writeText(folder / "bin/parity_imageio.so", "no library");
  const auto [damagedPassed, damaged] = runCopy(folder);
  EXPECT_FALSE(damagedPassed);
  EXPECT_NE(damaged.find("install libopenimageio2.4"), std::string::npos) << damaged;
  std::filesystem::remove(folder / "bin/parity_imageio.so");

  std::filesystem::copy_file(program.parent_path() / "parity_imageio.so", folder / "lib/parity/parity_imageio.so");
  const auto [installedPassed, installed] = runCopy(folder);
  EXPECT_TRUE(installedPassed) << installed;
}

} // namespace
} // namespace parity::base
