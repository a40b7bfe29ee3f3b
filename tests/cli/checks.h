// What the tests of the program share: its results read back, and the form that every refusal has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/image/image.h"
#include "base/lines_of.h"
#include "cli/run_parity.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {

// A small picture, under the validation layer: each of its messages fails the run.
inline const std::vector<std::string> kSmall = {"--size", "64x64", "--validation"};
inline const std::vector<std::string> kSun = {"--sun", "30,50,4"};
// An environment filtered in a tenth of the time, where its figures are not what is tested.
inline const std::vector<std::string> kRoughSky = {"--prefilter-size", "64", "--prefilter-samples", "8"};

// What the program says where there is no Vulkan driver; empty where there is one.
std::string missingDriver();

// A test with a folder of its own.
class FolderTest : public testing::Test {
protected:
  std::string path(const std::string& name) const { return (m_folder / name).string(); }
  // The file's path.
  std::string write(const std::string& name, const std::string& text) const {
    writeFile(m_folder / name, text);
    return path(name);
  }
  const TempFolder m_folder;
};

// One that renders: skipped, visibly, where there is no Vulkan driver.
class RenderingTest : public FolderTest {
protected:
  void SetUp() override;
  // The picture that parity render SCENE --path PATH makes, under the validation layer; what it said goes to m_err.
  base::Image render(const std::string& scene, const std::string& by, const std::vector<std::string>& more,
                     const std::string& file = "out.exr") const;
  mutable std::string m_err;
};

// Passes where the program came to an end by itself with this exit code; else says what it printed.
testing::AssertionResult exitedWith(int code, const RunResult& result);

// Whether a report is there, whatever its verdict: of tests whose pictures are too small for one.
bool isReported(const RunResult& result);

// Expects this exit code, nothing on stdout, and on stderr one line "error: ..." that holds all `parts`; and memory
// below 2 GiB (docs/design.md 10g).
void expectRefused(const RunResult& result, int code, const std::vector<std::string>& parts);

bool contains(const std::string& text, const std::string& part);
std::string readWholeFile(const std::filesystem::path& file);

// report.json of a report folder. Fails the test and returns null where it cannot be parsed.
nlohmann::json readReport(const std::filesystem::path& folder);

// Every file below the folder, hidden ones too, relative to it, sorted.
std::vector<std::string> listFiles(const std::filesystem::path& folder);

// Every picture that report.json names, sorted.
std::vector<std::string> listPictures(const nlohmann::json& report);

// The files of values that report.json names, sorted.
std::vector<std::string> listPixelFiles(const nlohmann::json& report);

// Whether the program was built with the report's page.
#ifdef PARITY_DASHBOARD
inline constexpr bool kHasPage = true;
#else
inline constexpr bool kHasPage = false;
#endif

// What the folder of a report of so many scenes holds besides pictures and values, sorted.
std::vector<std::string> reportFiles(std::size_t scenes);

// A budget file that judges everything, materials of any size, by its mean FLIP alone; `limits` as in "warn = 0.1, fail
// = 0.2".
std::string writeBudgets(const TempFolder& folder, const std::string& limits);

} // namespace parity::tests
