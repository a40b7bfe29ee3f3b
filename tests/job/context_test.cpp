// What the scenes of a run share: an environment is read once, and again when its file has changed.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/image/image_io.h"
#include "base/temp_folder.h"
#include "job/context.h"

namespace parity::job {
namespace {

void writeConstant(const std::filesystem::path& file, float radiance) {
  base::writeImage(file, base::Image(8, 4, 3, radiance));
}

TEST(ContextEnvironment, IsReadAgainWhenItsFileHasChanged) {
  const base::TempFolder folder;
  const std::string file = (folder / "sky.exr").string();
  writeConstant(file, 1);
  Context context(Settings{});
  const auto first = context.environment(file, 0);
  EXPECT_EQ(first->environment.radiance.pixels.front(), 1);
  EXPECT_EQ(context.environment(file, 0), first) << "it is at hand";
  Context second(context, Context::ForAnotherThread{});
  EXPECT_EQ(second.environment(file, 0), first) << "of the whole run";
  writeConstant(file, 2);
  const auto changed = second.environment(file, 0);
  EXPECT_EQ(changed->environment.radiance.pixels.front(), 2);
  EXPECT_NE(context.environment(file, 90), changed) << "turned";
}

TEST(ContextEnvironment, ThatIsNotThereIsAnErrorEachTime) {
  Context context(Settings{});
  for (int time = 0; time < 2; ++time) EXPECT_THROW(context.environment("no-such.hdr", 0), base::Error);
}

} // namespace
} // namespace parity::job
