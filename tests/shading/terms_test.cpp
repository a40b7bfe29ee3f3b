// The ids of the terms are the same for C++ and GLSL.
#include <array>

#include <gtest/gtest.h>

#include "shading/terms.h"

namespace parity::tests {
namespace {

// Of scenes without lobes beside the base's own, and of those with.
namespace base {
#include "shading/terms.glsl"
} // namespace base
#undef PARITY_SHADING_TERMS
#define PARITY_LOBES
namespace glsl {
#include "shading/terms.glsl"
} // namespace glsl
#undef PARITY_LOBES

using shading::Term;

TEST(Terms, GlslHasTheIdsOfCpp) {
  constexpr std::array<std::pair<int, Term>, shading::kTermCount> ids = {{
      {glsl::kTermSunDiffuse, Term::sunDiffuse},
      {glsl::kTermSunSpecular, Term::sunSpecular},
      {glsl::kTermLocalDiffuse, Term::localDiffuse},
      {glsl::kTermLocalSpecular, Term::localSpecular},
      {glsl::kTermLightmap, Term::lightmap},
      {glsl::kTermSkyDiffuse, Term::skyDiffuse},
      {glsl::kTermSkySpecular, Term::skySpecular},
      {glsl::kTermEmissive, Term::emissive},
      {glsl::kTermFog, Term::fog},
      {glsl::kTermCoatSpecular, Term::coatSpecular},
      {glsl::kTermSheen, Term::sheen},
  }};
  for (const auto& [id, term] : ids) EXPECT_EQ(id, static_cast<int>(term));
  EXPECT_EQ(glsl::kTermCount, static_cast<int>(shading::kTermCount));
  EXPECT_EQ(base::kTermCount, static_cast<int>(shading::kBaseTermCount));
  EXPECT_EQ(base::kTermFog, base::kTermCount - 1);
}

TEST(Terms, NamesAndIdsMatchBothWays) {
  for (std::size_t i = 0; i < shading::kTermCount; ++i)
    EXPECT_EQ(static_cast<std::size_t>(*shading::termByName(shading::kTermNames[i])), i);
  EXPECT_EQ(shading::kTermNames[static_cast<std::size_t>(Term::skySpecular)], "skySpecular");
  EXPECT_FALSE(shading::termByName("specular"));
}

} // namespace
} // namespace parity::tests
