// Bad files: each gives one line that names the file and the place, and exit code 4.
#include <limits>

#include "base/jpeg_bytes.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;

// Edits a good quad and expects the load to fail with a line that names the file and holds `parts`.
void expectRefused(const std::function<void(GltfFile&)>& edit, std::vector<std::string> parts) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  edit(file);
  const std::string path = writeExternal(folder, file);
  parts.push_back(path + ": ");
  expectError([&] { scenes::loadScene(path); }, parts);
}

// The same of a file that holds `value` at a place, a JSON pointer.
void expectRefused(const char* place, const json& value, const std::vector<std::string>& parts) {
  expectRefused([&](GltfFile& f) { f.json[json::json_pointer(place)] = value; }, parts);
}

void expectTextRefused(const std::string& text, std::vector<std::string> parts) {
  const TempFolder folder;
  writeFile(folder / "bad.gltf", text);
  parts.push_back("bad.gltf: ");
  expectError([&] { scenes::loadScene((folder / "bad.gltf").string()); }, parts);
}

TEST(BadInput, MissingFileFolderAndEmptyFile) {
  const TempFolder folder;
  expectError([&] { scenes::loadScene((folder / "none.gltf").string()); }, {"none.gltf"});
  expectError([&] { scenes::loadScene(folder.path().string()); }, {folder.path().string()});
  expectTextRefused("", {"the file is empty"});
  for (const auto& [file, reason] : {std::pair("suite.toml", "is not a glTF scene; give a suite with --suite"),
                                     {"picture.png", "is not a glTF scene (.gltf or .glb)"}}) {
    writeFile(folder / file, "[[scene]]\n");
    expectError([&] { scenes::loadScene((folder / file).string()); }, {std::string(file) + ": " + reason});
  }
  expectError([] { scenes::loadScene("builtin:sphere"); }, {"builtin:sphere", "did you mean 'builtin:spheres'?"});
}

TEST(BadInput, JsonErrorsNameLineAndColumn) {
  expectTextRefused("{\n \"asset\": {\"version\": \"2.0\",}\n}", {"JSON: line 2, column 29"});
  expectTextRefused("{\"asset\": ", {"JSON: line 1, column 11"});
  expectTextRefused("[]", {"the root is not an object"});
  expectTextRefused("\"\xff\"", {"JSON", "last read: '\"?'"});
  expectTextRefused(std::string(100000, '['), {"JSON: is nested deeper than 64 levels"});
  expectTextRefused("{}", {"asset: is missing"});
}

TEST(BadInput, AnotherVersionIsAllThatIsSaid) {
  const auto expectOnly = [](const std::string& asset, const std::string& problem) {
    const TempFolder folder;
    writeFile(folder / "old.gltf", "{\"asset\": " + asset + ", \"scene\": \"main\", \"nodes\": {}}");
    const std::string path = (folder / "old.gltf").string();
    EXPECT_EQ(base::errorOf([&] { scenes::loadScene(path); }).what(), path + ": " + problem);
  };
  expectOnly("{\"version\": \"1.0\"}", "/asset/version: is '1.0', expected glTF 2");
  expectOnly("{\"version\": 1}", "/asset/version: is '1', expected glTF 2");
  expectOnly("{\"version\": \"2.0\", \"minVersion\": \"2.1\"}", "/asset/minVersion: is '2.1', expected 2.0");
  expectTextRefused("{\"asset\": {\"version\": 2.0}, \"scene\": \"main\"}",
                    {"/asset/version: is 2.0, expected a string", "/scene: is \"main\""});
}

TEST(BadInput, WrongTypesNameThePlace) {
  expectRefused("/materials/0/alphaCutoff", "half", {"/materials/0/alphaCutoff: is \"half\", expected a number"});
  expectRefused("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1},
                {"/materials/0/pbrMetallicRoughness/baseColorFactor: holds 3 numbers, expected 4"});
  expectRefused("/nodes/0/mesh", 0.5, {"/nodes/0/mesh: is 0.5, expected a whole number"});
  expectRefused("/nodes/0/mesh", -1, {"/nodes/0/mesh"});
  expectRefused("/accessors/0/count", 1e10, {"/accessors/0/count: is 10000000000.0, expected a whole number"});
  expectRefused("/skins", 3, {"/skins: is 3, expected an array"});
  expectRefused("/meshes/0", 3, {"/meshes/0: is 3, expected an object"});
  expectRefused("/nodes/0/translation", {1, 1e39, 0},
                {"/nodes/0/translation/1: is 1e+39, expected a number that 32 bits"});
  expectRefused("/materials/0/alphaMode", "SOLID", {"/materials/0/alphaMode", "SOLID"});
  expectRefused([](GltfFile& f) { f.json["meshes"][0].erase("primitives"); }, {"/meshes/0/primitives: is missing"});
  expectRefused([](GltfFile& f) { f.primitive()["attributes"].erase("POSITION"); },
                {"the scene is empty: every object is ignored: /meshes/0/primitives/0: has no POSITION, not drawn"});
  expectRefused("/meshes/0/primitives/0/mode", 9, {"/primitives/0/mode: is 9, expected one of 0, 1, 2, 3, 4, 5, 6"});
}

TEST(BadInput, IndicesOutOfRangeNameTheArray) {
  expectRefused("/meshes/0/primitives/0/material", 7,
                {"/meshes/0/primitives/0/material: is 7, expected an index of materials, 0 to 0"});
  expectRefused("/meshes/0/primitives/0/attributes/NORMAL", 99,
                {"attributes/NORMAL: is 99, expected an index of accessors"});
  expectRefused("/meshes/0/primitives/0/indices", 4, {"/primitives/0/indices: is 4"});
  expectRefused("/accessors/1/bufferView", 50, {"/accessors/1/bufferView: is 50"});
  expectRefused("/bufferViews/1/buffer", 1, {"/bufferViews/1/buffer: is 1"});
  expectRefused("/nodes/0/mesh", 1, {"/nodes/0/mesh: is 1"});
  expectRefused("/nodes/0/children", {5}, {"/nodes/0/children/0: is 5"});
  expectRefused("/nodes/0/camera", 0, {"there are no cameras"});
  expectRefused("/scene", 1, {"/scene: is 1"});
  expectRefused("/materials/0/normalTexture", {{"index", 0}},
                {"/materials/0/normalTexture/index: is 0, expected no index, because there are no textures"});
  expectRefused("/textures", {{{"source", 0}}}, {"/textures/0/source: is 0"});
  expectRefused(
      "/nodes/0/extensions/KHR_lights_punctual/light", 0,
      {"/nodes/0/extensions/KHR_lights_punctual/light: is 0, expected no index, because there are no lights"});
}

TEST(BadInput, VertexIndicesBeyondTheVertices) {
  expectRefused(
      [](GltfFile& f) {
        f.primitive()["indices"] = f.add<std::uint16_t>({0, 1, 4}, "SCALAR");
      },
      {"/meshes/0/primitives/0/indices (/accessors/4): index 4 at element 2 is out of range: there are 4"});
  expectRefused(
      [](GltfFile& f) {
        f.primitive()["indices"] = f.add<float>({0, 1, 2}, "SCALAR");
      },
      {"indices are not scalars of an unsigned integer type"});
}

TEST(BadInput, AccessorsThatLeaveTheirBufferView) {
  expectRefused("/accessors/0/count", 5,
                {"/accessors/0: 5 elements of 12 bytes, 12 apart, start at byte 0, and must end within the 48 bytes "
                 "of /bufferViews/0"});
  expectRefused("/accessors/0/byteOffset", 2147483644, {"/accessors/0"});
  expectRefused("/accessors/0/byteOffset", 2,
                {"byteOffset: is 2 in a view at 0, expected their sum to be a multiple of 4"});
  expectRefused("/accessors/0/count", 0, {"/accessors/0/count: is 0, expected at least 1"});
  expectRefused("/accessors/0/componentType", 5130, {"/accessors/0", "5130"});
  expectRefused("/accessors/0/type", "MAT4", {"/accessors/0: 4 elements of 64 bytes"});
  expectRefused("/meshes/0/primitives/0/attributes/NORMAL", 2, {"NORMAL (/accessors/2): has 2 comp"});
  expectRefused(
      [](GltfFile& f) {
        f.primitive()["attributes"]["NORMAL"] = f.add<float>({0, 0, 1}, "VEC3");
      },
      {"NORMAL (/accessors/4): has 1 elements, but POSITION has 4"});
}

TEST(BadInput, BufferViewsThatLeaveTheirBuffer) {
  expectRefused("/bufferViews/3/byteLength", 1000,
                {"/bufferViews/3: ends at byte 1128, expected at most 140, the byteLength of /buffers/0"});
  expectRefused("/bufferViews/0/byteOffset", 2147483647, {"/bufferViews/0"});
  expectRefused("/bufferViews/0/byteStride", 6, {"byteStride: is 6, expected a multiple of 4"});
  expectRefused("/bufferViews/0/byteStride", 8,
                {"/accessors/0: has elements of 12 bytes, expected at most the byteStride 8"});
  expectRefused("/bufferViews/0/byteLength", 0, {"/bufferViews/0/byteLength: is 0, expected at least 1"});
}

TEST(BadInput, BuffersThatAreMissingFoldersTooShortOrOutside) {
  const auto withUri = [](const json& uri, std::size_t length = 140) {
    return [=](GltfFile& f) { f.json["buffers"] = {{{"uri", uri}, {"byteLength", length}}}; };
  };
  expectRefused(withUri("scene.bin", 141), {"/buffers/0: holds 140 bytes, expected 141, its byteLength"});
  expectRefused(withUri("absent.bin"), {"/buffers/0/uri: 'absent.bin'"});
  expectRefused(withUri("."), {"/buffers/0/uri"});
  expectRefused(withUri("../scene.bin"), {"/buffers/0/uri: '../scene.bin' points outside the asset's folder"});
  expectRefused(withUri("%2e%2e%2fscene.bin"), {"/buffers/0/uri", "points outside the asset's folder"});
  expectRefused(withUri("/etc/hostname"), {"/buffers/0/uri: '/etc/hostname' is absolute"});
  expectRefused(withUri("file:///etc/hostname"), {"/buffers/0/uri", "has a scheme"});
  expectRefused(withUri("http://example.org/a.bin"), {"/buffers/0/uri", "has a scheme"});
  expectRefused(withUri("data:application/octet-stream;base64,AA*A"), {"/buffers/0/uri", "base64"});
  expectRefused(withUri("data:nothing"), {"/buffers/0/uri", "comma"});
  expectRefused(withUri(""), {"/buffers/0/uri: is an empty uri"});
  expectRefused("/buffers", {{{"byteLength", 140}}}, {"/buffers/0: has no uri, and the file has no binary chunk"});
}

TEST(BadInput, LinksOutOfTheFolder) {
  const TempFolder outside, folder;
  GltfFile file = makeQuad();
  writeFile(outside / "secret.bin", file.bin);
  std::filesystem::create_symlink(outside / "secret.bin", folder / "inside.bin");
  file.json["buffers"] = {{{"uri", "inside.bin"}, {"byteLength", file.bin.size()}}};
  const std::string path = writeExternal(folder, file);
  expectError([&] { scenes::loadScene(path); }, {"/buffers/0/uri: 'inside.bin' points outside", "symbolic link"});
}

TEST(BadInput, NumbersThatAreNotFinite) {
  const float inf = std::numeric_limits<float>::infinity();
  expectRefused(
      [&](GltfFile& f) {
        f.primitive()["attributes"]["POSITION"] = f.add<float>({0, 0, 0, 1, inf, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
      },
      {"attributes/POSITION (/accessors/4): element 1 is not finite"});
  expectRefused(
      [&](GltfFile& f) {
        f.primitive()["attributes"]["TEXCOORD_0"] = f.add<float>({0, 0, std::nanf(""), 1, 0, 1, 1, 0}, "VEC2");
      },
      {"TEXCOORD_0", "element 1 is not finite"});
  expectRefused("/nodes", {{{"scale", {1e30, 1, 1}}, {"children", {1}}}, {{"scale", {1e30, 1, 1}}, {"mesh", 0}}},
                {"/nodes/1: its transform to the world is not finite"});
  expectRefused("/nodes/0/rotation", {0, 0, 0, 0}, {"/nodes/0/rotation"});
  expectRefused("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                {"/nodes/0/matrix: is not affine"});
}

TEST(BadInput, HierarchiesThatAreNoTrees) {
  const auto withNodes = [](const json& nodes) { return [=](GltfFile& f) { f.json["nodes"] = nodes; }; };
  expectRefused(withNodes({{{"mesh", 0}, {"children", {0}}}}), {"/nodes/0: is its own ancestor"});
  expectRefused(withNodes({{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}}), {"hierarchy has a cycle"});
  expectRefused(withNodes({{{"mesh", 0}, {"children", {1, 2}}}, {{"children", {2}}}, json::object()}),
                {"/nodes/2: has two parents, /nodes/0 and /nodes/1"});
  expectRefused(withNodes({{{"mesh", 0}, {"children", {1, 1}}}, json::object()}), {"/nodes/1: is a child", "twice"});
  expectRefused(
      [](GltfFile& f) {
        f.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, json::object()};
        f.json["scenes"][0]["nodes"] = {0, 1};
      },
      {"/scenes/0/nodes: /nodes/1 is a child of another node, expected each root"});
}

TEST(BadInput, RequiredExtensionsThatAreNotSupported) {
  expectRefused("/extensionsRequired", {"ACME_shell", "KHR_materials_ior", "ACME_fur"},
                {"/extensionsRequired: ACME_shell is not supported", "/extensionsRequired: ACME_fur is not supported"});
}

TEST(BadInput, AJpegWithBytesCutOutIsAWarning) {
  std::vector<std::byte> jpeg = base::makeNoisyJpeg(128, 96);
  const auto warningsOf = [&] {
    GltfFile file = makeQuad();
    file.json["images"] = {{{"bufferView", file.addBufferView(jpeg)}, {"mimeType", "image/jpeg"}, {"name", "bark"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return loadQuadlike(file).warnings;
  };
  EXPECT_FALSE(hasWarning(warningsOf(), "JPEG"));
  jpeg.erase(jpeg.begin() + 2000, jpeg.begin() + 2600);
  EXPECT_TRUE(hasWarning(warningsOf(), "/images/0 'bark': the JPEG is damaged; the decoder invented a part of it"));
}

TEST(BadInput, AGlbThatIsNoneIsNamedAsSuch) {
  const TempFolder folder;
  const auto expectGlb = [&](const std::string& bytes, const char* reason) {
    writeFile(folder / "a.glb", bytes);
    expectError([&] { scenes::loadScene((folder / "a.glb").string()); }, {"a.glb: byte ", reason});
  };
  expectGlb("x", "byte 1: is truncated: a glb header has 12 bytes");
  expectGlb("g", "byte 1: is truncated: a glb header has 12 bytes");
  expectGlb("PK\x03\x04 an archive of something", "byte 0: is not a glb: the magic 'glTF' is missing");
}

TEST(BadInput, ALightsRangeOfNothing) {
  for (const double range : {0.0, -1.0})
    expectRefused(
        [&](GltfFile& f) {
          f.json["extensionsUsed"] = {"KHR_lights_punctual"};
          f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", range}}};
          f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
        },
        {"/extensions/KHR_lights_punctual/lights/0/range: is not above 0"});
}

TEST(BadInput, EmptyScenes) {
  expectRefused([](GltfFile& f) { f.json["nodes"][0].erase("mesh"); },
                {"the scene is empty: none of its nodes has a mesh"});
  expectRefused("/scenes/0/nodes", json::array(), {"the scene is empty: it has no nodes"});
  expectRefused(
      "/meshes/0/primitives/0/mode", 0,
      {"the scene is empty: every object is ignored: /meshes/0/primitives/0: points and lines are not drawn"});
  expectRefused("/nodes/0/scale", {1, 0, 0},
                {"the scene is empty: every object is ignored: /nodes/0 'quad': has a scale of 0"});
  expectTextRefused("{\"asset\": {\"version\": \"2.0\"}}", {"the scene is empty: the file has no mesh"});
}

void expectImageRefused(const std::vector<std::byte>& bytes, std::vector<std::string> parts) {
  parts.push_back("/images/0 'wood'");
  expectRefused(
      [&](GltfFile& f) {
        f.json["images"] = {{{"bufferView", f.addBufferView(bytes)}, {"mimeType", "image/png"}, {"name", "wood"}}};
        f.json["textures"] = {{{"source", 0}}};
        f.material()["normalTexture"] = {{"index", 0}};
      },
      parts);
}

TEST(BadInput, ImagesThatDoNotDecode) {
  const std::vector<std::byte> png = makePng(64, 64);
  expectImageRefused(std::vector<std::byte>(40, std::byte{7}), {"is not a PNG, JPEG, WebP or KTX 2 image"});
  expectImageRefused({png.begin(), png.begin() + 20}, {"truncated header"});
  expectImageRefused({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(png.size() / 2)}, {});
  std::vector<std::byte> zero = png;
  for (std::size_t i = 16; i < 20; ++i) zero[i] = std::byte{0};
  expectImageRefused(zero, {"a width or height of 0"});
  std::vector<std::byte> huge = png;
  huge[16] = std::byte{0x10};
  expectImageRefused(huge, {"expected at most 16384 a side (--max-image)"});
  expectRefused(
      [](GltfFile& f) {
        f.json["images"] = {{{"uri", "absent.png"}}};
        f.json["textures"] = {{{"source", 0}}};
        f.material()["normalTexture"] = {{"index", 0}};
      },
      {"/images/0 'absent.png'"});
  expectRefused(
      [](GltfFile& f) {
        const std::string head("\xabKTX 20\xbb\r\n\x1a\n", 12);
        const auto* bytes = reinterpret_cast<const std::byte*>(head.data());
        f.json["images"] = {{{"bufferView", f.addBufferView(std::vector<std::byte>(bytes, bytes + head.size()))},
                             {"mimeType", "image/ktx2"}}};
        f.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
        f.material()["normalTexture"] = {{"index", 0}};
      },
      {"/images/0", "the KTX 2 image is truncated: its header ends beyond the file"});
  expectRefused("/images", json::array({json::object()}), {"/images/0: needs either a uri"});
  expectRefused("/images", {{{"uri", "../../x.png"}}},
                {"/images/0/uri: '../../x.png' points outside the asset's folder"});
}

TEST(BadInput, TexturesAndSamplersThatWeCannotRead) {
  const auto textured = [](GltfFile& f) {
    f.json["images"] = {{{"bufferView", f.addBufferView(makePng(2, 2))}, {"mimeType", "image/png"}}};
    f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    f.json["samplers"] = {json::object()};
    f.material()["normalTexture"] = {{"index", 0}};
  };
  expectRefused(
      [&](GltfFile& f) {
        textured(f);
        f.json["samplers"][0]["wrapS"] = 1;
      },
      {"/samplers/0/wrapS: is 1, expected one of 10497, 33071, 33648"});
  expectRefused(
      [&](GltfFile& f) {
        textured(f);
        f.json["samplers"][0]["minFilter"] = 9727;
      },
      {"/samplers/0/minFilter: is 9727, expected one of 9728"});
}

TEST(BadInput, CamerasOutOfRange) {
  const auto withCamera = [](const json& camera) {
    return [=](GltfFile& f) {
      f.json["cameras"] = {camera};
      f.json["nodes"][0]["camera"] = 0;
    };
  };
  expectRefused(withCamera({{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}}),
                {"/cameras/0/perspective/yfov"});
  expectRefused(withCamera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}}}}),
                {"/cameras/0/perspective: needs 0 < znear < zfar"});
  expectRefused(withCamera({{"type", "fisheye"}}), {"fisheye"});
  expectRefused(withCamera({{"type", "perspective"}}), {"amera"});
}

} // namespace
} // namespace parity::tests
