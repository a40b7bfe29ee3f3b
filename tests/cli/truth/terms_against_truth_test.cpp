// The high-end path's terms, one by one, against the exact integrals, on shipped scenes under an environment alone and
// under one with a sun and lamps. Observed: lights below 3e-4, skyDiffuse .01 %, skySpecular .6 to 3.1 %,
// coatSpecular 1.2 to 4.9 % (rims of coats of roughness .2 and .4 under bright lamps), sheen .7 to 1.2 %, transmission
// 3 to 5 % (rims of rough balls of glass).
#include <cmath>
#include <map>
#include <ostream>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using shading::Term;

struct TermCase {
  std::string name, scene;
  std::vector<std::string> light;
  // Root of summed squared differences over that of the truth's squares: at most, by term. A term that is not named
  // has to be black in both.
  std::map<Term, double> limits;
  std::string size = "96x64"; // of the picture; more where spheres are small
};

// Names the case where a test fails.
void PrintTo(const TermCase& c, std::ostream* out) { *out << c.name; }

class TermsAgainstTruth : public RenderingTest, public testing::WithParamInterface<TermCase> {};

TEST_P(TermsAgainstTruth, EachTermIsWithinItsLimit) {
  const TermCase& c = GetParam();
  const auto render = [&](const std::string& path) {
    const std::filesystem::path file = m_folder / (path + ".exr");
    EXPECT_TRUE(
        exitedWith(0, runParity(join({{"render", c.scene, "--path", path, "-o", file.string(), "--terms", "--size",
                                       c.size, "--error", "2%", "--background", "0,0,0", "--validation"},
                                      c.light}))));
    return base::readImage(file);
  };
  const base::Image highend = render("highend"), truth = render("reference");
  const std::size_t terms = static_cast<std::size_t>(truth.channels) / 3 - 1;
  for (const auto& [term, limit] : c.limits) ASSERT_LT(static_cast<std::size_t>(term), terms);
  for (std::size_t t = 0; t < terms; ++t) {
    const Term term = static_cast<Term>(t);
    const int first = channelOf(term, terms);
    double difference = 0, total = 0;
    for (std::size_t p = 0; p < truth.pixelCount(); ++p)
      for (int k = 0; k < 3; ++k) {
        const std::size_t i = p * static_cast<std::size_t>(truth.channels) + static_cast<std::size_t>(first + k);
        difference += std::pow(double(highend.pixels[i]) - truth.pixels[i], 2);
        total += std::pow(double(truth.pixels[i]), 2);
      }
    if (!c.limits.contains(term)) {
      EXPECT_EQ(difference, 0) << shading::kTermNames[t];
      EXPECT_EQ(total, 0) << shading::kTermNames[t];
      continue;
    }
    ASSERT_GT(total, 0) << shading::kTermNames[t];
    std::printf("%s %s: %.4f\n", c.name.c_str(), std::string(shading::kTermNames[t]).c_str(),
                std::sqrt(difference / total));
    EXPECT_LE(std::sqrt(difference / total), c.limits.at(term)) << shading::kTermNames[t];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, TermsAgainstTruth,
    testing::Values(TermCase{"SpheresUnderAStudio",
                             "builtin:spheres",
                             {"--env", "builtin:studio"},
                             {{Term::skyDiffuse, 0.002}, {Term::skySpecular, 0.035}, {Term::emissive, 1e-6}}},
                    TermCase{"SpheresUnderASkyWithItsSun",
                             "builtin:spheres",
                             {"--env", "builtin:sky"},
                             {{Term::sunDiffuse, 1e-3},
                              {Term::sunSpecular, 2e-3},
                              {Term::skyDiffuse, 0.002},
                              {Term::skySpecular, 0.012},
                              {Term::emissive, 1e-6}}},
                    TermCase{"LobesUnderAStudio",
                             "builtin:lobes",
                             {"--env", "builtin:studio"},
                             {{Term::skyDiffuse, 0.002},
                              {Term::skySpecular, 0.015},
                              {Term::emissive, 1e-3},
                              {Term::coatSpecular, 0.012},
                              {Term::sheen, 0.02},
                              {Term::transmission, 0.06}},
                             "132x88"},
                    TermCase{"LobesUnderASkyWithItsSun",
                             "builtin:lobes",
                             {"--env", "builtin:sky"},
                             {{Term::sunDiffuse, 1e-3},
                              {Term::sunSpecular, 2e-3},
                              {Term::skyDiffuse, 0.002},
                              {Term::skySpecular, 0.012},
                              {Term::emissive, 1e-3},
                              {Term::coatSpecular, 0.015},
                              {Term::sheen, 0.02},
                              {Term::transmission, 0.04}},
                             "132x88"},
                    TermCase{"MaterialsUnderAStudioAndASun",
                             "builtin:materials",
                             {"--env", "builtin:studio", "--sun", "30,50,4"},
                             {{Term::sunDiffuse, 1e-3},
                              {Term::sunSpecular, 2e-3},
                              {Term::skyDiffuse, 0.002},
                              {Term::skySpecular, 0.02}}},
                    TermCase{"LampsAtNight",
                             "builtin:lamps",
                             {"--env", "builtin:night"},
                             {{Term::sunDiffuse, 1e-3},
                              {Term::sunSpecular, 2e-3},
                              {Term::localDiffuse, 1e-3},
                              {Term::localSpecular, 2e-3},
                              {Term::skyDiffuse, 0.002},
                              {Term::skySpecular, 0.012}}}),
    [](const auto& which) { return which.param.name; });

} // namespace
} // namespace parity::tests
