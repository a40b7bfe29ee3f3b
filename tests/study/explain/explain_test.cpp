// Explanations on a device: the table of sets against every set rendered by its own program.
#include "study/explain/explain.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "job/context.h"
#include "job/knobs.h"
#include "scenes/view.h"
#include "study/explain/advice.h"
#include "study/explain/asset.h"
#include "study/explain/explain_text.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {
namespace {

job::SceneRequest request(const std::string& scene, const char* environment, bool sun) {
  job::SceneRequest request;
  request.scene = scene;
  request.name = "scene";
  request.settings.width = request.settings.height = 48;
  request.settings.device.validation = true;
  request.settings.scene.environment = environment;
  if (sun) request.settings.scene.sun = scenes::SunRequest{30, 50, 4};
  request.views = {{}};
  return request;
}

// Of small pictures: no material is too small to be judged.
compare::Budgets ofSmallPictures() {
  compare::Budgets budgets = compare::defaultBudgets();
  for (compare::BudgetRule& rule : budgets.materials) rule.minPixels = 1;
  return budgets;
}

// Every set of three switches by the wide program equals the specialised ones: to the last bit of each figure. And the
// advice is what brute force over those finds.
void expectBruteForceAgrees(const job::SceneRequest& wanted, const std::vector<std::string>& switches) {
  job::Context context(wanted.settings);
  const SceneExplanation found = explainScene(context, wanted, {.switches = switches}, ofSmallPictures(), {});
  ASSERT_EQ(found.switches.size(), switches.size());
  const job::PathChoice paths = job::pathsOf(wanted.settings);
  const job::PreparedScene prepared = job::prepareScene(context, wanted, paths);
  job::SceneOnDevice scene(context, prepared, prepared.settings, paths);
  SetRenderer renderer(context, prepared, scene, prepared.settings, paths, scenes::makeCamera(prepared.scene, {}, 1));
  std::vector<std::size_t> seen;
  for (std::size_t m = 0; m < renderer.coverage().size(); ++m)
    if (!renderer.coverage()[m].pixels.empty()) seen.push_back(m);
  ASSERT_EQ(found.materials.size(), seen.size());
  std::vector<std::vector<double>> flip(seen.size());
  for (SwitchMask mask = 0; mask < SwitchMask{1} << switches.size(); ++mask) {
    const std::vector<double> rendered =
        renderer.flip(withSwitches(prepared.settings, found.switches, mask), SetRenderer::Program::specialised, seen);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(found.materials[i].flip[mask], rendered[i]) << found.materials[i].name << ", set " << mask;
      flip[i].push_back(rendered[i]);
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const MaterialExplanation& m = found.materials[i];
    for (const SetOutcome& set : m.best) {
      EXPECT_GT(set.cost.operations, 0);
      if (set.rendered) {
        EXPECT_EQ(*set.rendered, flip[i][set.mask]) << m.name;
      }
    }
    if (m.flip.front() <= m.limit) continue;
    // The smallest set within the limit, if there is one, is what is advised.
    int smallest = 99;
    for (SwitchMask mask = 0; mask < flip[i].size(); ++mask)
      if (flip[i][mask] <= m.limit) smallest = std::min(smallest, std::popcount(mask));
    if (smallest < 99) {
      EXPECT_EQ(std::popcount(m.repair), smallest) << m.name;
      EXPECT_LE(flip[i][m.repair], m.limit);
    }
  }
}

TEST(Explain, EqualsBruteForceOnMaterialsUnderTheSky) {
  expectBruteForceAgrees(request("builtin:materials", "builtin:sky", false),
                         {"formulas=refit", "sky-sh=9", "precision=fp32"});
}
TEST(Explain, EqualsBruteForceOnSpheresInTheStudio) {
  expectBruteForceAgrees(request("builtin:spheres", "builtin:studio", true),
                         {"capture=fp16", "sky-sh=9", "mobile-target=r11g11b10f"});
}
TEST(Explain, EqualsBruteForceOnLamps) {
  job::SceneRequest lamps = request("builtin:lamps", "builtin:studio", false);
  expectBruteForceAgrees(lamps, {"formulas=refit", "mobile-local-lights=off"});
}
TEST(Explain, EqualsBruteForceOnShadows) {
  job::SceneRequest shadows = request("builtin:shadows", "builtin:studio", true);
  shadows.settings.shadows = true;
  expectBruteForceAgrees(shadows, {"mobile-sun-shadow=on", "mobile-spot-shadow=on"});
}

TEST(Explain, ChoosesSwitchesThatHelpAndSaysWhyOthersAreLeftOut) {
  const job::SceneRequest materials = request("builtin:materials", "builtin:sky", false);
  job::Context context(materials.settings);
  const SceneExplanation found = explainScene(context, materials, {}, ofSmallPictures(), {});
  const auto has = [&](const char* id) { return std::ranges::count(found.switches, id, &Switch::id) == 1; };
  EXPECT_TRUE(has("formulas=refit"));
  EXPECT_TRUE(has("mobile-fully-rough=on"));
  EXPECT_LE(found.switches.size(), kMaxSwitches);
  EXPECT_TRUE(std::ranges::is_partitioned(found.switches, [](const Switch& each) { return !each.cheapens; }));
  const auto skipped = std::ranges::find(found.skipped, "mobile-coat=refit", &Skipped::what);
  ASSERT_NE(skipped, found.skipped.end());
  EXPECT_EQ(skipped->why, "the scene has no clear coat");
  const auto gold = std::ranges::find(found.materials, "gold", &MaterialExplanation::name);
  ASSERT_NE(gold, found.materials.end());
  ASSERT_FALSE(gold->advice.empty());
  EXPECT_TRUE(gold->advice.front().starts_with("formulas=refit: mean FLIP ")) << gold->advice.front();
  EXPECT_FALSE(gold->ranges.empty());
  const std::string text = toText(found, false);
  EXPECT_NE(text.find("gold: mean FLIP"), std::string::npos);
  EXPECT_NE(text.find("best set of each size"), std::string::npos);
}

// Of slivers nothing is advised; hostile names stay on their line.
TEST(Explain, LeavesOutWhatIsTooSmallToJudge) {
  job::SceneRequest wanted = request("builtin:materials", "builtin:sky", false);
  job::Context context(wanted.settings);
  compare::Budgets budgets = ofSmallPictures();
  budgets.materials.insert(budgets.materials.begin(), budgets.materials.front());
  budgets.materials.front().material = "gold";
  budgets.materials.front().minPixels = 100000;
  const SceneExplanation found = explainScene(context, wanted, {.switches = {"sky-sh=9"}}, budgets, {});
  EXPECT_EQ(found.tooSmall, std::vector<std::string>{"gold"});
  EXPECT_EQ(std::ranges::count(found.materials, "gold", &MaterialExplanation::name), 0);
  EXPECT_NE(toText(found, true).find("gold: too small to judge"), std::string::npos);
  SceneExplanation hostile = found;
  hostile.materials.front().name = "a\nb\xff";
  EXPECT_EQ(toText(hostile, true).find("a\nb"), std::string::npos);
  EXPECT_NO_THROW(toJson({hostile}, {}, ""));
}

// What is said of a change of the asset is the figure of a scene that was loaded with it.
TEST(Explain, SuggestsAChangeOfTheAssetThatBringsItWithinItsLimit) {
  const job::SceneRequest wanted = request("builtin:materials", "builtin:sky", false);
  job::Context context(wanted.settings);
  ExplainWish wish{.switches = {"sky-sh=9"}, .materials = {"gold"}};
  const auto explainGold = [&](double limit) {
    compare::Budgets budgets = ofSmallPictures();
    for (compare::BudgetRule& rule : budgets.materials)
      for (compare::BudgetCheck& check : rule.checks)
        if (check.statistic.name == "flip.mean") check.warn = limit;
    const SceneExplanation found = explainScene(context, wanted, wish, budgets, {});
    EXPECT_EQ(found.materials.size(), 1u);
    return found.materials.at(0);
  };
  const MaterialExplanation today = explainGold(1);
  EXPECT_FALSE(today.asset) << "it is within its limit";
  const double limit = today.flip.front() - 0.002;
  const MaterialExplanation over = explainGold(limit);
  EXPECT_EQ(over.flip.front(), today.flip.front());
  ASSERT_TRUE(over.asset);
  EXPECT_LE(over.asset->flip, limit);
  EXPECT_TRUE(std::ranges::any_of(over.advice, [&](const std::string& sentence) {
    return sentence.find(describe(*over.asset)) != std::string::npos;
  }));

  const job::PathChoice paths = job::pathsOf(wanted.settings);
  job::PreparedScene prepared = job::prepareScene(context, wanted, paths);
  const auto gold = static_cast<std::size_t>(
      std::ranges::find(prepared.scene.materials, "gold", &scenes::Material::name) - prepared.scene.materials.begin());
  AssetChange change = *over.asset;
  prepared.scene.materials[gold] = withChange(prepared.scene.materials[gold], change).value();
  job::SceneOnDevice scene(context, prepared, prepared.settings, paths);
  SetRenderer renderer(context, prepared, scene, prepared.settings, paths, scenes::makeCamera(prepared.scene, {}, 1));
  EXPECT_EQ(renderer.flip(prepared.settings, SetRenderer::Program::specialised, {gold}).front(), over.asset->flip);
}

// Pictures of the advised set are the crops of a report; masks lie where the shader reads the texture.
TEST(Explain, IllustratesWhereAskedTo) {
  job::SceneRequest wanted = request("builtin:materials", "builtin:sky", false);
  wanted.settings.width = wanted.settings.height = 96;
  job::Context context(wanted.settings);
  ExplainWish wish{.switches = {"formulas=refit"}, .illustrates = true};
  const SceneExplanation found = explainScene(context, wanted, wish, ofSmallPictures(), {});
  std::size_t advised = 0, masks = 0;
  for (const MaterialExplanation& m : found.materials) {
    EXPECT_EQ(m.illustration.advised.empty(), m.repair == 0) << m.name;
    advised += m.illustration.advised.empty() ? 0 : 1;
    if (m.illustration.mask.empty()) continue;
    ++masks;
    EXPECT_GT(m.illustration.texels, 0) << m.name;
    EXPECT_LE(m.illustration.texels, 1) << m.name;
    EXPECT_FALSE(m.illustration.input.empty());
  }
  EXPECT_GT(advised, 0u);
  EXPECT_GT(masks, 0u);
  wish.illustrates = false;
  for (const MaterialExplanation& m : explainScene(context, wanted, wish, ofSmallPictures(), {}).materials)
    EXPECT_TRUE(m.illustration.advised.empty() && m.illustration.mask.empty());
}

TEST(Explain, RefusesWhatItCannotTurn) {
  const job::SceneRequest plain = request("builtin:furnace", "builtin:studio", false);
  const auto expectRefused = [&](job::SceneRequest wanted, const std::vector<std::string>& switches,
                                 base::ExitCode code, const std::vector<std::string>& parts) {
    job::Context context(wanted.settings);
    base::expectError([&] { explainScene(context, wanted, {.switches = switches}, compare::defaultBudgets(), {}); },
                      parts, code);
  };
  expectRefused(plain, {"mobile-coat=refit"}, base::ExitCode::usage, {"mobile-coat=refit", "has no clear coat"});
  expectRefused(request("builtin:furnace", "builtin:studio", true), {"formulas=refit", "direct-lobe=d-approx"},
                base::ExitCode::usage, {"need each other"});
  expectRefused(plain, std::vector<std::string>(8, "sky-sh=9"), base::ExitCode::usage, {"at most 7"});
  job::SceneRequest unseen = plain;
  unseen.views[0].orbit = glm::vec3(0, 0, 100);
  unseen.views[0].target = glm::vec3(0, 900, 0);
  expectRefused(unseen, {}, base::ExitCode::notComparable, {"no chosen material is seen, or only too small"});
  job::SceneRequest turned = plain;
  turned.settings.pathNames = {"mobile", "highend"};
  expectRefused(turned, {}, base::ExitCode::usage, {"--paths", "second of two paths"});
}

} // namespace
} // namespace parity::explain
