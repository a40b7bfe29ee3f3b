// Prints the constants that shading/refit.glsl holds, with their errors. build/fit_refit; half a minute on 2 cores.
#include <cstdio>

#include "study/fit/refit.h"
#include "study/fit/refit_text.h"

int main() {
  using namespace parity::fit;
  const Refit refit = fitRefit({}, [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); });
  std::fputs(formatShader(refit, Language::glsl).c_str(), stdout);
}
