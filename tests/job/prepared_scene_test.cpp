// What may be freed of a scene while it is rendered.
#include <gtest/gtest.h>

#include "job/prepared_scene.h"

namespace parity::job {
namespace {

PreparedScene makePrepared() {
  PreparedScene prepared;
  for (int i = 0; i < 2; ++i) prepared.scene.images.push_back({"image", base::Image8(4, 4, 4, 9)});
  return prepared;
}

TEST(ImageRelease, FreesThePixelsOfOneImage) {
  PreparedScene prepared = makePrepared();
  for (const Paths& paths : {Paths{}, Paths{.reference = true}}) {
    const auto release = imageRelease(prepared, paths);
    ASSERT_TRUE(release);
    release(1);
    EXPECT_TRUE(prepared.scene.images[1].pixels.empty());
    EXPECT_FALSE(prepared.scene.images[0].pixels.empty());
  }
  prepared.shadows = true;
  EXPECT_TRUE(imageRelease(prepared, Paths{})) << "no reference, no shadows";
}

TEST(ImageRelease, LeavesThemWhereTheReferenceLetsLightThroughMasks) {
  PreparedScene prepared = makePrepared();
  prepared.shadows = true;
  EXPECT_FALSE(imageRelease(prepared, Paths{.reference = true}));
}

} // namespace
} // namespace parity::job
