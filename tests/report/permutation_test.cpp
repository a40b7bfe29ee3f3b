// The shaders of a scene: means by path, and what report.json and the table say of them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/permutation.h"
#include "report/report.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

constexpr const char* kWords = "cost of a pixel: high-end 900 scalar operations and 11.0 texture fetches, mobile 375 "
                               "and 4.5: 0.42 of the operations, 0.41 of the fetches";

TEST(PermutationCosts, AreMeansOverThePixelsOfEachPath) {
  const std::vector<PathCost> paths = costsByPath(makeSampleReport().scenes[0].permutations);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].path, "highend");
  EXPECT_EQ(paths[1].pixels, 400000u);
  EXPECT_DOUBLE_EQ(paths[1].operations, (3 * 300 + 600) / 4.); // three quarters of the pixels, a quarter
  EXPECT_DOUBLE_EQ(paths[1].fp16, 200);
  EXPECT_DOUBLE_EQ(paths[1].fetches, (3 * 4 + 6) / 4.);
  EXPECT_EQ(paths[1].samplers, 6u);
}

TEST(PermutationCosts, AreSaidOnlyWhereBothPathsAreKnown) {
  std::vector<PermutationResult> permutations = makeSampleReport().scenes[0].permutations;
  EXPECT_EQ(describeCosts(permutations), kWords);
  permutations.push_back({"third", "none", "none", 100, 0, PermutationCost{.fp32 = 450, .fetches = 11}});
  EXPECT_EQ(describeCosts(permutations),
            std::string(kWords) + "; third 450 and 11.0: 0.50 of the operations, 1.00 of the fetches");
  permutations.pop_back();
  permutations[0].cost.reset();
  EXPECT_EQ(describeCosts(permutations), "");
  EXPECT_EQ(costsByPath(permutations).size(), 1u);
  EXPECT_EQ(describeCosts({}), "");
}

TEST(PermutationCosts, StandInTheJsonWithTheirPermutation) {
  const auto document = nlohmann::json::parse(toJson(makeSampleReport()));
  const auto& permutations = document.at("scenes").at(0).at("permutations");
  ASSERT_EQ(permutations.size(), 3u);
  EXPECT_EQ(permutations[2].at("features"), "some nonmetal");
  EXPECT_EQ(permutations[2].at("textures"), "base colour, normal");
  EXPECT_EQ(permutations[2].at("pixels"), 100000);
  EXPECT_EQ(permutations[2].at("samplers"), 6);
  EXPECT_EQ(permutations[2].at("cost"),
            (nlohmann::json{{"fp32", 400}, {"fp16", 200}, {"integer", 30}, {"fetches", 6}, {"openLoops", 1}}));
  Report plain = makeSampleReport();
  plain.scenes[0].permutations[2].cost.reset();
  EXPECT_FALSE(nlohmann::json::parse(toJson(plain)).at("/scenes/0/permutations/2"_json_pointer).contains("cost"));
}

TEST(PermutationCosts, StandInTheTable) {
  const Report report = makeSampleReport();
  EXPECT_NE(toTable(report, {}, {.all = true}).find(std::string("Lamp: ") + kWords), std::string::npos);
  Report plain = report;
  for (PermutationResult& each : plain.scenes[0].permutations) each.cost.reset();
  EXPECT_EQ(toTable(plain, {}, {.all = true}).find("scalar operations"), std::string::npos);
}

} // namespace
} // namespace parity::report
