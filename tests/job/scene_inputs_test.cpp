// Digests of what a scene is made from: each change shows in its own digest, and in no other.
#include "job/scene/scene_inputs.h"

#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"

namespace parity::job {
namespace {

using base::TempFolder;

struct Given {
  Settings run;
  SceneRequest request;
  std::vector<scenes::SourceFile> sources;
};

Given makeGiven(const TempFolder& folder) {
  Given given;
  base::writeText(folder / "studio.hdr", "light");
  base::writeText(folder / "other.hdr", "another light");
  base::writeText(folder / "baked/manifest.json", "a bake");
  base::writeText(folder / "again/manifest.json", "another bake");
  given.request.name = "Desk";
  given.request.scene = (folder / "Desk.gltf").string();
  given.request.settings.scene.environment = (folder / "studio.hdr").string();
  given.request.settings.scene.baked = (folder / "baked").string();
  given.request.views.emplace_back().name = "front";
  given.request.name = "Desk";
  scenes::ExternalPictures& engine = given.request.externals.emplace_back();
  engine.name = "engine", engine.test = (folder / "shots" / "{scene}-{view}.png").string();
  engine.calibration = (folder / "shots" / "calibration.png").string();
  given.sources = {{folder / "Desk.gltf", "11"},
                   {folder / "wood.png", "22"},
                   {folder / "metal.png", "33"},
                   {folder / "shots" / "Desk-front.png", "44"},
                   {folder / "shots" / "calibration.png", "55"}};
  return given;
}

std::optional<report::SceneInputs> inputsOf(const Given& given) {
  return job::inputsOf(given.request, conditionsOf(given.run, given.request, gpu::DeviceReport()), given.sources);
}

using Digests = std::array<std::string, 5>;

Digests digestsOf(const Given& given) {
  const std::optional<report::SceneInputs> inputs = inputsOf(given);
  EXPECT_TRUE(inputs);
  return inputs ? Digests{inputs->asset, inputs->environment, inputs->request, inputs->bake, inputs->pictures}
                : Digests();
}

TEST(SceneInputs, AreFiveDigestsOfTwelveDigits) {
  const TempFolder folder;
  for (const std::string& digest : digestsOf(makeGiven(folder))) {
    EXPECT_EQ(digest.size(), 12u);
    EXPECT_EQ(digest.find_first_not_of("0123456789abcdef"), std::string::npos) << digest;
  }
}

TEST(SceneInputs, ChangeShowsInItsOwnDigestAlone) {
  const TempFolder folder;
  enum Digest { asset, environment, request, bake, pictures };
  struct Case {
    Digest digest;
    std::function<void(Given&)> change;
  };
  const std::vector<Case> cases = {
      {asset, [](Given& g) { g.sources[0].hash = "44"; }},
      {asset, [](Given& g) { g.sources[2].hash = "44"; }},
      {asset, [](Given& g) { std::swap(g.sources[1].hash, g.sources[2].hash); }},
      {asset, [](Given& g) { g.sources.erase(g.sources.begin() + 1); }},
      {pictures, [](Given& g) { g.sources[3].hash = "66"; }},
      {pictures, [](Given& g) { g.sources[4].hash = "66"; }},
      {pictures, [](Given& g) { g.sources.pop_back(); }},
      {environment, [&](Given& g) { g.request.settings.scene.environment = (folder / "other.hdr").string(); }},
      {environment, [](Given& g) { g.request.settings.scene.environment = "builtin:sky"; }},
      {request,
       [](Given& g) {
         g.request.settings.scene.sun = scenes::SunRequest{30, 50, 4};
       }},
      {request, [](Given& g) { g.request.settings.width = 640; }},
      {request,
       [](Given& g) {
         g.request.views[0].name = "back";
         g.sources[3].file.replace_filename("Desk-back.png");
       }},
      {request, [](Given& g) { g.request.views[0].fovYDeg = 30; }},
      {bake, [&](Given& g) { g.request.settings.scene.baked = (folder / "again").string(); }},
  };
  const Digests before = digestsOf(makeGiven(folder));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Given changed = makeGiven(folder);
    cases[i].change(changed);
    const Digests after = digestsOf(changed);
    for (std::size_t digest = 0; digest < after.size(); ++digest)
      EXPECT_EQ(after[digest] != before[digest], digest == cases[i].digest) << "case " << i << ", digest " << digest;
  }
}

TEST(SceneInputs, NamesPlacesAndTheOrderOfReadingDoNotCount) {
  const TempFolder here, there;
  Given given = makeGiven(here), moved = makeGiven(there);
  moved.request.name = "Table";
  std::filesystem::rename(there / "studio.hdr", there / "renamed.hdr");
  moved.request.settings.scene.environment = (there / "renamed.hdr").string();
  std::swap(moved.sources[1], moved.sources[2]);
  moved.sources[0].file = moved.request.scene = (there / "Table.gltf").string();
  moved.sources[3].file = there / "shots" / "Table-front.png";
  EXPECT_EQ(digestsOf(moved), digestsOf(given));
}

TEST(SceneInputs, AreEmptyWhereThereIsNothing) {
  const TempFolder folder;
  Given given = makeGiven(folder);
  given.request.settings.scene.environment.clear();
  given.request.settings.scene.baked.clear();
  const Digests digests = digestsOf(given);
  EXPECT_EQ(digests[1], "");
  EXPECT_EQ(digests[3], "");
  given.request.externals.clear();
  given.sources.resize(3);
  EXPECT_EQ(digestsOf(given)[4], "");
  given.sources.clear();
  EXPECT_FALSE(inputsOf(given)) << "a file that was not read";
  given.request.scene = "builtin:materials";
  ASSERT_TRUE(inputsOf(given)) << "it has no files";
  const std::string materials = inputsOf(given)->asset;
  given.request.scene = "builtin:room";
  EXPECT_NE(inputsOf(given)->asset, materials);
}

} // namespace
} // namespace parity::job
