// What the tests of the program share: its results read back, and the form that every refusal has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/run_parity.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {

// A small picture, under the validation layer: each of its messages fails the run.
inline const std::vector<std::string> kSmall = {"--size", "64x64", "--validation"};
inline const std::vector<std::string> kSun = {"--sun", "30,50,4"};

// What the program says where there is no Vulkan driver; empty where there is one.
std::string missingDriver();

// A test that renders: skipped, visibly, where there is no Vulkan driver. Has a folder of its own.
class RenderingTest : public testing::Test {
protected:
  void SetUp() override;
  const TempFolder m_folder;
};

// Passes where the program came to an end by itself with this exit code; else says what it printed.
testing::AssertionResult exitedWith(int code, const RunResult& result);

// Whether a report is there, whatever its verdict: of tests whose pictures are too small for one.
bool isReported(const RunResult& result);

// Expects this exit code, nothing on stdout, and on stderr one line "error: ..." that holds all `parts`; and memory
// below 2 GiB (DESIGN 10).
void expectRefused(const RunResult& result, int code, const std::vector<std::string>& parts);

std::vector<std::string> splitLines(const std::string& text);
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

// What a report's folder holds besides pictures and values, sorted.
std::vector<std::string> reportFiles();

// A budget file that judges everything, materials of any size, by its mean FLIP alone; `limits` as in "warn = 0.1, fail
// = 0.2".
std::string writeBudgets(const TempFolder& folder, const std::string& limits);

} // namespace parity::tests
