// What a scene says about itself.
#include <gtest/gtest.h>

#include "scenes/names.h"
#include "scenes/scene.h"

namespace parity::tests {
namespace {

using scenes::Material;

Material dielectric() {
  Material material;
  material.metallic = 0;
  return material;
}

TEST(Material, DefaultReflectanceIsExactlyFourPercent) {
  EXPECT_EQ(dielectric().dielectricF0(), glm::vec3(0.04f));
  Material material = dielectric();
  material.ior = 2;
  EXPECT_FLOAT_EQ(material.dielectricF0().x, 1.f / 9.f);
  material.ior = 0; // KHR_materials_ior: reflects all
  EXPECT_EQ(material.dielectricF0(), glm::vec3(1));
  material = dielectric();
  material.specular = 0.5f;
  material.specularColor = {1, 100, 0};
  EXPECT_EQ(material.dielectricF0(), glm::vec3(0.02f, 0.5f, 0)) << "min(0.04 * color, 1) * specular";
}

TEST(Material, IsNonmetalOnlyWhereNothingCanMakeItOtherwise) {
  EXPECT_FALSE(Material{}.isNonmetal()) << "glTF's metallicFactor is 1 by default";
  EXPECT_TRUE(dielectric().isNonmetal());
  Material material = dielectric();
  material.metallicRoughnessTexture.image = 0;
  EXPECT_TRUE(material.isNonmetal()) << "a texture scales a factor of 0";
  material.metallic = 1e-6f;
  EXPECT_FALSE(material.isNonmetal());
  material = dielectric();
  material.specularTexture.image = 0;
  EXPECT_FALSE(material.isNonmetal()) << "it may lower F0";
  material = dielectric();
  material.specularColor = {1, 1, 0.99f};
  EXPECT_FALSE(material.isNonmetal());
  material = dielectric();
  material.ior = 1.4999f;
  EXPECT_FALSE(material.isNonmetal());
}

TEST(Scene, BoundsCoverTransformedTrianglesAndIgnoreStrayVertices) {
  scenes::Scene scene;
  EXPECT_EQ(scene.bounds().radius(), 0.f) << "empty";
  scenes::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {99, 99, 99}};
  mesh.indices = {0, 1, 2};
  scene.meshes = {mesh};
  glm::mat4 moved(2.f);
  moved[3] = glm::vec4(10, 0, 0, 1);
  scene.instances = {{0, glm::mat4(1.f), "a"}, {0, moved, "b"}};
  EXPECT_EQ(scene.bounds().lower, glm::vec3(0));
  EXPECT_EQ(scene.bounds().upper, glm::vec3(12, 2, 0));
  EXPECT_EQ(scene.triangleCount(), 2u);
}

TEST(Names, AreCutBetweenUtf8Characters) {
  std::string name;
  for (int i = 0; i < 100; ++i) name += "\u00e9"; // two bytes each
  const std::string clean = scenes::cleanName(name);
  EXPECT_LE(clean.size(), 128u);
  EXPECT_EQ(clean.substr(clean.size() - 3), "...");
  EXPECT_EQ((clean.size() - 3) % 2, 0u);
  EXPECT_EQ(scenes::cleanName(" a\tb\x7f "), "a b");
  EXPECT_EQ(scenes::cleanName("\n"), "");
  EXPECT_EQ(scenes::cleanName("G, \xA5"), "G, \uFFFD");
}

} // namespace
} // namespace parity::tests
