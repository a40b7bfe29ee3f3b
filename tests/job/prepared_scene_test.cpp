// What may be freed of a scene while it is rendered; what a scene has.
#include <gtest/gtest.h>

#include "job/scene/prepared_scene.h"
#include "job/scene/scene_content.h"

namespace parity::job {
namespace {

PreparedScene makePrepared() {
  PreparedScene prepared;
  for (int i = 0; i < 2; ++i) prepared.scene.images.push_back({"image", base::Image8(4, 4, 4, 9)});
  return prepared;
}

TEST(ImageRelease, FreesThePixelsOfOneImage) {
  PreparedScene prepared = makePrepared();
  for (const bool truth : {false, true}) {
    const auto release = imageRelease(prepared, {.chosen = allPaths(), .truth = truth});
    ASSERT_TRUE(release);
    release(1);
    EXPECT_TRUE(prepared.scene.images[1].pixels.empty());
    EXPECT_FALSE(prepared.scene.images[0].pixels.empty());
  }
  prepared.settings.shadows = true;
  EXPECT_TRUE(imageRelease(prepared, {.chosen = allPaths()})) << "no truth, no shadows";
}

TEST(ImageRelease, LeavesThemWhereTheTruthLetsLightThroughMasks) {
  PreparedScene prepared = makePrepared();
  prepared.settings.shadows = true;
  EXPECT_FALSE(imageRelease(prepared, {.chosen = {}, .truth = true}));
}

TEST(SceneContent, HasFogAndLightmapsWhereTheyAre) {
  PreparedScene prepared = makePrepared();
  EXPECT_EQ(contentOf(prepared), (std::set<std::string>{""}));
  prepared.scene.fog = scenes::Fog{};
  const auto baked = std::make_shared<bake::BakedLight>();
  prepared.baked = baked; // of captures alone
  EXPECT_EQ(contentOf(prepared), (std::set<std::string>{"", "fog"}));
  baked->halfPages.emplace_back(2, 4, 4);
  EXPECT_EQ(contentOf(prepared), (std::set<std::string>{"", "fog", "lightmap"}));
}

} // namespace
} // namespace parity::job
