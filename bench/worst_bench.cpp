// Whether parity worst finds what many views at random find:
//   build/bench_worst [--views N] [--points N] [--refined N] [--env ENV] [--sun] SCENE...
//
// For each scene the time of the search, its worst mean FLIP, and that of N (2,000) random views of the same domain at
// the same size.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/stopwatch.h"
#include "job/context.h"
#include "study/explain/worst.h"

int main(int argc, char** argv) {
  using namespace parity;
  int views = 2000, found = 0, scenes = 0;
  explain::WorstOptions options;
  std::string environment = "builtin:studio";
  bool sun = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--views") == 0) {
      views = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--points") == 0) {
      options.points = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--refined") == 0) {
      options.refined = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--env") == 0) {
      environment = argv[++i];
    } else if (std::strcmp(argv[i], "--sun") == 0) {
      sun = true;
    } else {
      job::SceneRequest request;
      request.scene = argv[i];
      request.name = argv[i];
      request.settings.width = request.settings.height = 512;
      request.settings.scene.environment = environment;
      if (sun) request.settings.scene.sun = scenes::SunRequest{30, 50, 4};
      request.views = {{}};
      job::Context context(request.settings);
      const base::Stopwatch watch(nullptr, "");
      const explain::WorstResult result = explain::findWorst(context, request, options, {});
      const double seconds = watch.elapsedMs() / 1000;
      double searched = 0;
      for (const explain::WorstView& view : result.views) searched = std::max(searched, view.searched);
      const double random = explain::worstOfRandomViews(context, request, options, views, 1);
      ++scenes;
      found += searched >= random;
      std::printf("%-60s %5.1f s  found %.4f  random %.4f  %s\n", argv[i], seconds, searched, random,
                  searched >= random ? "at least" : "less");
      std::fflush(stdout);
    }
  }
  std::printf("%d of %d\n", found, scenes);
}
