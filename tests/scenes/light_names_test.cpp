// What reports call lights.
#include <gtest/gtest.h>

#include "scenes/light_names.h"

namespace parity::scenes {
namespace {

TEST(LightNames, AreTheirOwnOrTheirKindAndPlaceAndNeverTwice) {
  std::vector<Light> lights(6);
  lights[0].name = lights[2].name = "lamp";
  lights[1].kind = LightKind::spot;
  lights[3].kind = LightKind::directional;
  lights[4].name = "line\nbreak";
  lights[5].name = "spot light 2"; // as the second is called
  EXPECT_EQ(lightNames(lights), (std::vector<std::string>{"lamp", "spot light 2", "lamp (2)", "directional light 4",
                                                          "line break", "spot light 2 (2)"}));
}

} // namespace
} // namespace parity::scenes
