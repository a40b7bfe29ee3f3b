// What the scenes of a run share: an environment is read once, and again when its file has changed.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
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

// The cache keeps the levels while the run goes on; once the run has ended, they are there.
TEST(ContextEnvironment, LevelsAreInTheCacheOnceTheRunHasEnded) {
  for (const int threads : {1, 2}) {
    const base::ThreadLimit limit(threads);
    const base::TempFolder folder;
    Settings settings;
    settings.cacheFolder = (folder / "cache").string();
    scenes::Environment sky;
    sky.name = "sky";
    sky.radiance = base::Image(8, 4, 3, 0.5f);
    const lighting::PrefilterOptions options{.faceSize = lighting::kMinFaceSize, .sampleCount = 4};
    const auto keptOf = [&](const Context& context) {
      for (const base::CacheKind& kind : context.cache().describe().kinds)
        if (kind.name == "environment") return kind.entries;
      return std::size_t{0};
    };
    std::vector<std::byte> made;
    {
      Context context(settings);
      made = lighting::toBytes(*context.environmentLight(sky, options));
      if (threads == 1) {
        EXPECT_EQ(keptOf(context), 1u) << "one thread stores at once";
      }
    }
    Context later(settings);
    EXPECT_EQ(keptOf(later), 1u) << threads;
    EXPECT_EQ(lighting::toBytes(*later.environmentLight(sky, options)), made) << threads;
  }
}

} // namespace
} // namespace parity::job
