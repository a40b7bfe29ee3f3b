// Extensions of textures and materials: other workflows, image formats, variants.
#include <cmath>

#include "base/file.h"
#include "base/image/image_io.h"
#include "scenes/gltf/file/image_header.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/specular_glossiness.h"
#include "scenes/load.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Material;
using scenes::Scene;

// 4x3 texels, top left red, bottom right white with an alpha of 128: written by libwebp's cwebp 1.2.4, lossless (VP8L),
// lossy with alpha (VP8X) and lossy (VP8, of one colour).
constexpr const char* kLossless = "UklGRmwAAABXRUJQVlA4TF8AAAAvA4AAEF9gGICayyCZEGYx5AntlYaZtm3yF0T5qxAKaOfGYGYCJoGbvKQi"
                                  "mKcRZiAAEScY4YTB/jjRiAL4YuiFQkEjy+0rc17l3qXL5myQBZiADGcOKfVHEHZE/2M0FwA=";
constexpr const char* kExtended =
    "UklGRqQAAABXRUJQVlA4WAoAAAAQAAAAAwAAAgAAQUxQSA0AAAAA///////q1b//1aqAAFZQOCBwAAAAcAIAnQEqBAADAADAEiWwAnRMgH9AnCsG"
    "v+HH5AD+2H/+H7r6//Hb3Cy7tsjZCtrobM+Z/+DX8UAr2Afw1LSjzK3/bL+XLWv9Tf//g8/8aWX3r/4Cb942fu/P/6wh/WYswX+3P8UOmfyb3zAv"
    "EAAAAA==";
constexpr const char* kLossy =
    "UklGRjwAAABXRUJQVlA4IDAAAAAQAgCdASoEAAMAAMASJaACdLoB+AH4AAPIAP75qO//RguA4Hxg//YOmDLn+GgA"
    "AAA=";

Scene loadWithImage(const std::string& base64, const json& texture) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["images"] = {{{"uri", "data:image/webp;base64," + base64}, {"name", "leaf"}},
                         {{"bufferView", file.addBufferView(makePng(7, 7))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {texture};
  file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
  return scenes::loadScene(writeEmbedded(folder, file));
}

TEST(GltfTextures, WebpIsReadBeforeItsFallback) {
  const json texture = {{"source", 1}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  const Scene scene = loadWithImage(kLossless, texture);
  const base::Image8& image = scene.images.at(0).pixels;
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 3);
  const auto texel = [&](int x, int y) { return std::vector<int>(image.at(x, y), image.at(x, y) + 4); };
  EXPECT_EQ(texel(0, 0), (std::vector<int>{255, 0, 0, 255}));
  EXPECT_EQ(texel(1, 0), (std::vector<int>{170, 85, 0, 255}));
  EXPECT_EQ(texel(3, 2), (std::vector<int>{255, 255, 255, 128})) << "alpha is not multiplied into the colour";
  EXPECT_NEAR(loadWithImage(kLossy, texture).images.at(0).pixels.at(2, 1)[0], 128, 6);
  EXPECT_EQ(loadWithImage(kExtended, texture).images.at(0).pixels.height, 3);
}

TEST(GltfTextures, BasisUniversalIsReadBeforeItsFallback) {
  const std::filesystem::path data = std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ktx2";
  const auto load = [&](const std::string& name, const json& texture) {
    const TempFolder folder;
    GltfFile file = makeQuad();
    file.json["images"] = {
        {{"bufferView", file.addBufferView(base::readFile(data / name))}, {"mimeType", "image/ktx2"}},
        {{"bufferView", file.addBufferView(makePng(7, 7))}, {"mimeType", "image/png"}}};
    file.json["textures"] = {texture};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
    return scenes::loadScene(writeEmbedded(folder, file));
  };
  const json basis = {{"KHR_texture_basisu", {{"source", 0}}}};
  expectError(
      [&] {
        load("basis.png", {{"extensions", {{"KHR_texture_basisu", {{"source", 5}}}}}});
      },
      {"KHR_texture_basisu/source: is 5, expected an index of images"});
  EXPECT_EQ(load("basis.png", {{"extensions", basis}}).images.at(0).pixels.width, 42) << "told by its bytes";
  if (!std::filesystem::exists(std::filesystem::path(PARITY_BINARY_DIR) / "parity_basis.so"))
    GTEST_SKIP() << "built without npm or wabt: no transcoder of KTX 2";
  const base::Image8 golden = base::readImage8(data / "uastc.png");
  EXPECT_EQ(load("uastc_zstd.ktx2", {{"source", 1}, {"extensions", basis}}).images.at(0).pixels.pixels, golden.pixels);
  EXPECT_EQ(load("etc1s.ktx2", {{"extensions", basis}}).images.at(0).pixels.height, 30);
}

// Four are decoded at a time on every machine: the transcoder's memory counts for these, not for all images of a scene.
TEST(GltfTextures, ManyOfBasisUniversalFitIntoTheLimitOfMemory) {
  if (!std::filesystem::exists(std::filesystem::path(PARITY_BINARY_DIR) / "parity_basis.so"))
    GTEST_SKIP() << "built without npm or wabt: no transcoder of KTX 2";
  const std::vector<std::byte> image =
      base::readFile(std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ktx2/uastc.ktx2");
  const auto load = [&](std::size_t mebibytes) {
    const TempFolder folder;
    GltfFile file = makeQuad();
    const json material = file.material();
    for (int i = 0; i < 12; ++i) {
      file.json["images"].push_back({{"bufferView", file.addBufferView(image)}, {"mimeType", "image/ktx2"}});
      file.json["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", i}}}}}});
      file.json["materials"][i] = material;
      file.json["materials"][i]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", i}}}};
      file.json["meshes"][0]["primitives"][i] = file.json["meshes"][0]["primitives"][0];
      file.json["meshes"][0]["primitives"][i]["material"] = i;
    }
    scenes::LoadOptions options;
    options.maxMemoryBytes = mebibytes << 20;
    return scenes::loadScene(writeEmbedded(folder, file), options).images.size();
  };
  EXPECT_EQ(load(200), 12u) << "32 MiB for each would be 384";
  expectError([&] { load(20); }, {"/images: needs 129 MiB", "--max-memory"});
}

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

TEST(ImageHeader, TellsFormatAndSizeOfEachKind) {
  using scenes::ImageFormat;
  const scenes::ImageHeader png = scenes::readImageHeader(makePng(5000, 1));
  EXPECT_EQ(png.format, ImageFormat::png);
  EXPECT_EQ(png.width, 5000u);
  // ITU-T T.81, B.2: start, an application segment, a frame of 3 x 5 (height first), a scan, the end.
  const std::string frame("\xff\xd8\xff\xe0\x00\x04zz\xff\xc2\x00\x0b\x08\x00\x05\x00\x03\x01\x01\x11\x00", 21);
  const std::string scan("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00"
                         "abc",
                         13);
  scenes::ImageHeader jpeg = scenes::readImageHeader(bytesOf(frame + scan + "\xff\xd9"));
  EXPECT_EQ(jpeg.format, ImageFormat::jpeg);
  EXPECT_EQ(jpeg.width, 3u);
  EXPECT_EQ(jpeg.height, 5u);
  EXPECT_FALSE(jpeg.isCutOff);
  EXPECT_TRUE(scenes::readImageHeader(bytesOf(frame + scan)).isCutOff);
  EXPECT_EQ(scenes::readImageHeader(bytesOf("\xabKTX 20\xbb\r\n\x1a\n")).format, ImageFormat::ktx2);
  EXPECT_EQ(scenes::readImageHeader(bytesOf("GIF89a")).format, ImageFormat::unknown);
  EXPECT_EQ(scenes::readImageHeader({}).format, ImageFormat::unknown);
  const std::string riff("RIFF\x64\x00\x00\x00WEBPVP8 ", 16); // promises 100 bytes
  EXPECT_TRUE(scenes::readImageHeader(bytesOf(riff + std::string(20, 'x'))).isCutOff);
}

Material loadGlossy(const json& extension, std::vector<std::string>* warnings = nullptr) {
  GltfFile file = makeQuad();
  file.material() = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}, {"metallicFactor", 1}}},
                     {"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}};
  const Scene scene = loadQuadlike(file);
  if (warnings) *warnings = scene.warnings;
  return scene.materials.at(0);
}

// The extension's text: c_diff = diffuse * (1 - max(specular)), F0 = specular, roughness = 1 - glossiness.
TEST(GltfSpecularGlossiness, FactorsKeepTheirMeaning) {
  const Material material = loadGlossy(
      {{"diffuseFactor", {0.5, 0.25, 1, 0.75}}, {"specularFactor", {0.2, 0.4, 0.1}}, {"glossinessFactor", 0.7}});
  EXPECT_EQ(material.metallic, 0.f);
  EXPECT_NEAR(material.roughness, 0.3f, 1e-6f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(material.baseColor[c], (glm::vec3(0.5f, 0.25f, 1.f) * 0.6f)[c]);
    EXPECT_FLOAT_EQ(material.dielectricF0()[c], (glm::vec3(0.2f, 0.4f, 0.1f))[c]);
  }
  EXPECT_EQ(material.baseColor.a, 0.75f);
  EXPECT_FALSE(material.isNonmetal());
  const Material defaults = loadGlossy(json::object()); // white specular, no diffuse left
  EXPECT_EQ(defaults.baseColor, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(defaults.dielectricF0(), glm::vec3(1));
  EXPECT_EQ(defaults.roughness, 0.f);
}

TEST(GltfSpecularGlossiness, DerivedTexelsFollowTheFormula) {
  base::Image8 packed(2, 1, 4), diffuse(4, 2, 4);
  const std::uint8_t packedTexels[] = {10, 200, 30, 51, 255, 255, 255, 255};
  std::copy(std::begin(packedTexels), std::end(packedTexels), packed.pixels.begin());
  for (std::size_t i = 0; i < diffuse.pixels.size(); ++i) diffuse.pixels[i] = static_cast<std::uint8_t>(30 + 5 * i);
  const scenes::DerivedImage roughness{.specularGlossiness = 0, .glossinessFactor = 0.5f};
  const base::Image8 rough = scenes::derive(roughness, &packed, nullptr);
  ASSERT_EQ(rough.width, 2);
  EXPECT_EQ(rough.at(0, 0)[1], 230); // 1 - 51/255 * 0.5 = 0.9: 229.5, to nearest
  EXPECT_EQ(rough.at(1, 0)[1], 128); // 1 - 0.5
  const scenes::DerivedImage color{.kind = scenes::DerivedImage::Kind::baseColor,
                                   .specularGlossiness = 0,
                                   .diffuse = 1,
                                   .diffuseFactor = {1, 0.5f, 1},
                                   .specularFactor = {1, 0.5f, 1}};
  const base::Image8 base = scenes::derive(color, &packed, &diffuse);
  ASSERT_EQ(base.width, 4);
  ASSERT_EQ(base.height, 2);
  const auto linear = [](int code) { // IEC 61966-2-1
    const double s = code / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double kept = 1 - linear(200) * 0.5; // green is the largest of 10, 200 * .5, 30
  const auto code = [](double l) { return 255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055); };
  for (int y = 0; y < 2; ++y)
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(base.at(1, y)[c], code(linear(diffuse.at(1, y)[c]) * (c == 1 ? 0.5 : 1) * kept), 0.51);
      EXPECT_EQ(base.at(2, y)[c], 0) << "white specular leaves no diffuse";
    }
  EXPECT_EQ(base.at(3, 1)[3], diffuse.at(3, 1)[3]);
}

TEST(GltfSpecularGlossiness, TexturesBecomeThoseOfOurModel) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  writeFile(folder / "s.png", makePng(4, 4));
  writeFile(folder / "d.png", makePng(2, 2));
  file.json["images"] = {{{"uri", "s.png"}}, {{"uri", "d.png"}}};
  file.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  json extension = {{"specularGlossinessTexture", {{"index", 0}}}, {"diffuseTexture", {{"index", 1}}}};
  file.material()["extensions"] = {{"KHR_materials_pbrSpecularGlossiness", extension}};
  Scene scene = scenes::loadScene(writeExternal(folder, file));
  const Material& material = scene.materials[0];
  ASSERT_TRUE(material.baseColorTexture.present() && material.metallicRoughnessTexture.present() &&
              material.specularColorTexture.present());
  const auto sideOf = [&](const scenes::TextureSlot& slot) {
    return scene.images[static_cast<std::size_t>(slot.image)].pixels.width;
  };
  EXPECT_EQ(scene.images.size(), 3u) << "the packed one, and two derived ones; the diffuse one is not read itself";
  EXPECT_EQ(sideOf(material.baseColorTexture), 4);
  EXPECT_EQ(sideOf(material.metallicRoughnessTexture), 4);
  EXPECT_EQ(sideOf(material.specularColorTexture), 4);
  EXPECT_EQ(scene.images[static_cast<std::size_t>(material.metallicRoughnessTexture.image)].name,
            "s.png (roughness of glossiness)");
  EXPECT_TRUE(scene.warnings.empty());

  extension["diffuseTexture"]["texCoord"] = 1;
  file.primitive()["attributes"]["TEXCOORD_1"] = file.primitive()["attributes"]["TEXCOORD_0"];
  file.material()["extensions"] = {{"KHR_materials_pbrSpecularGlossiness", extension}};
  scene = scenes::loadScene(writeExternal(folder, file));
  EXPECT_EQ(sideOf(scene.materials[0].baseColorTexture), 2);
  EXPECT_TRUE(hasWarning(scene.warnings, "their textures have different uvs"));
}

GltfFile makeVariants() {
  GltfFile file = makeQuad();
  file.json["materials"] = {{{"name", "beige"}}, {{"name", "street"}}, {{"name", "beach"}}};
  file.json["extensions"] = {
      {"KHR_materials_variants", {{"variants", {{{"name", "Street"}}, {{"name", "Beach"}}, {{"name", "Night"}}}}}}};
  file.primitive()["extensions"] = {
      {"KHR_materials_variants",
       {{"mappings", {{{"material", 1}, {"variants", {0, 2}}}, {{"material", 2}, {"variants", {1}}}}}}}};
  return file;
}

TEST(GltfVariants, ChooseTheMaterialByNameOrNumber) {
  const TempFolder folder;
  const std::string path = writeGlb(folder, makeVariants());
  const auto materialWith = [&](const std::string& variant) {
    const Scene scene = scenes::loadScene(path, {.variant = variant});
    return scene.materials[scene.meshes.at(0).material].name;
  };
  EXPECT_EQ(materialWith(""), "beige");
  EXPECT_EQ(materialWith("Street"), "street");
  EXPECT_EQ(materialWith("Beach"), "beach");
  EXPECT_EQ(materialWith("2"), "street");
  expectError([&] { materialWith("Dune"); }, {"--variant: ", "no variant 'Dune'; known: 'Street' (0), 'Beach' (1)"},
              base::ExitCode::usage);
  expectError([&] { scenes::loadScene("builtin:spheres", {.variant = "a"}); }, {"--variant", "builtin:spheres"},
              base::ExitCode::usage);
  GltfFile broken = makeVariants();
  broken.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"] = {3};
  expectError(
      [&] { scenes::loadScene(writeGlb(folder, broken, "broken")); },
      {"/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants/0: is 3, expected an index "
       "of variants, 0 to 2"});
}

TEST(GltfScenes, AreChosenByNameOrNumber) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"mesh", 0}, {"name", "first"}}, {{"mesh", 0}, {"name", "second"}}};
  file.json["scenes"] = {{{"nodes", {0}}, {"name", "day"}}, {{"nodes", {1}}, {"name", "night"}}};
  file.json["scene"] = 1;
  const std::string path = writeGlb(folder, file);
  const auto nodeOf = [&](const std::string& name) {
    return scenes::loadScene(path, {.scene = name}).instances.at(0).node;
  };
  EXPECT_EQ(nodeOf(""), "second");
  EXPECT_EQ(nodeOf("day"), "first");
  EXPECT_EQ(nodeOf("1"), "second");
  expectError([&] { nodeOf("dusk"); }, {"--scene", "known: 'day' (0), 'night' (1)"}, base::ExitCode::usage);
}

} // namespace
} // namespace parity::tests
