// What is uploaded arrives whole, however large, and is told to be done with when nothing reads it any more.
#include "support/device.h"
#include "support/small_scenes.h"

#include "gpu/device/image_upload.h"
#include "gpu/surface/scene_buffers.h"
#include "support/mips.h"

namespace parity::gpu {
namespace {

class UploadTest : public tests::DeviceTest {
protected:
  // A mip of one layer, as it lies on the device.
  std::vector<std::byte> download(const DeviceImage& image, std::uint32_t mip, std::uint32_t layer, std::size_t bytes) {
    const Buffer to(device(), bytes);
    const DeviceImage::Shape& shape = image.shape();
    device().submit("download", [&](const vk::raii::CommandBuffer& commands) {
      changeLayout(commands, image, vk::ImageLayout::eShaderReadOnlyOptimal, vk::ImageLayout::eTransferSrcOptimal);
      commands.copyImageToBuffer(
          image.handle(), vk::ImageLayout::eTransferSrcOptimal, to.handle(),
          vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, mip, layer, 1}, {},
                              {std::max(shape.width >> mip, 1u), std::max(shape.height >> mip, 1u), 1}));
      changeLayout(commands, image, vk::ImageLayout::eTransferSrcOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    return to.downloadAs<std::byte>(bytes);
  }
};

constexpr vk::ImageUsageFlags kUsage =
    vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc;

// Different at every byte of a mip and between mips.
std::vector<std::byte> makePixels(std::size_t bytes, std::uint32_t seed) {
  std::vector<std::byte> pixels(bytes);
  std::uint32_t state = seed * 2654435761u + 1;
  for (std::byte& each : pixels) {
    state = state * 1664525u + 1013904223u;
    each = static_cast<std::byte>(state >> 24);
  }
  return pixels;
}

TEST_F(UploadTest, AnImageLargerThanTheStagingBufferHasAllItsMips) {
  DeviceImage::Shape shape{.width = 2501, .height = 2003, .mips = 3, .usage = kUsage}; // 20 MB and two more
  const DeviceImage image(device(), shape);
  ImageUpload upload(device(), image);
  std::vector<std::vector<std::byte>> mips;
  for (std::uint32_t mip = 0; mip < shape.mips; ++mip) {
    mips.push_back(makePixels(std::size_t{4} * (shape.width >> mip) * (shape.height >> mip), mip));
    upload.write(mip, mips.back());
  }
  upload.finish();
  for (std::uint32_t mip = 0; mip < shape.mips; ++mip)
    EXPECT_EQ(download(image, mip, 0, mips[mip].size()), mips[mip]) << mip;
}

TEST_F(UploadTest, ACubeOfWideTexelsHasAllItsLayers) {
  DeviceImage::Shape shape{.format = vk::Format::eR32G32B32A32Sfloat,
                           .width = 512,
                           .height = 512,
                           .mips = 1,
                           .cube = true,
                           .arraySize = 1,
                           .usage = kUsage}; // 24 MiB
  const std::size_t layerBytes = std::size_t{16} * 512 * 512;
  std::vector<std::byte> pixels = makePixels(6 * layerBytes, 7);
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] &= std::byte{0x3f}; // no NaN, which a copy may change
  const std::span<const std::byte> mip = pixels;
  const DeviceImage image(device(), shape, std::span{&mip, 1});
  for (std::uint32_t layer = 0; layer < 6; ++layer) {
    const auto found = download(image, 0, layer, layerBytes);
    EXPECT_TRUE(
        std::equal(found.begin(), found.end(), pixels.begin() + static_cast<std::ptrdiff_t>(layer * layerBytes)))
        << layer;
  }
}

TEST_F(UploadTest, GeometryOfManyPartsIsThatOfAllMeshesWithDefaultsForWhatOneLacks) {
  scenes::Scene scene = tests::makeQuadScene();
  scenes::Mesh dense = scene.meshes[0];
  dense.tangents.clear();
  const std::size_t count = 300000; // 3.6 MB of positions: more than one part
  dense.positions.resize(count);
  dense.normals.resize(count);
  dense.uv0.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<float>(i);
    dense.positions[i] = {value, value + 0.5f, -value};
    dense.normals[i] = {-value, 0, value};
    dense.uv0[i] = {value, 2 * value};
  }
  for (std::uint32_t i = 4; i + 2 < count; ++i) dense.indices.insert(dense.indices.end(), {i, i + 1, i + 2});
  scene.meshes = {tests::makeQuad(0), dense, tests::makeQuad(0)};
  const SceneBuffers buffers(device(), scene);

  ASSERT_EQ(buffers.meshes().size(), 3u);
  EXPECT_EQ(buffers.meshes()[2].baseVertex, count + 4);
  EXPECT_EQ(buffers.meshes()[2].firstIndex, 6 + dense.indices.size());
  const auto expected = [&](const auto& attributeOf) {
    auto all = attributeOf(scene.meshes[0]);
    for (std::size_t m = 1; m < 3; ++m) {
      const auto& more = attributeOf(scene.meshes[m]);
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  };
  EXPECT_EQ(buffers.positions.downloadAs<glm::vec3>(count + 8), expected([](const auto& m) { return m.positions; }));
  EXPECT_EQ(buffers.normals.downloadAs<glm::vec3>(count + 8), expected([](const auto& m) { return m.normals; }));
  EXPECT_EQ(buffers.indices.downloadAs<std::uint32_t>(dense.indices.size() + 12),
            expected([](const auto& m) { return m.indices; }));
  EXPECT_EQ(buffers.tangents.downloadAs<glm::vec4>(count + 8), expected([](scenes::Mesh m) {
              m.tangents.resize(m.positions.size(), glm::vec4(0));
              return m.tangents;
            }));
  EXPECT_EQ(buffers.uvs.downloadAs<glm::vec4>(count + 8), expected([](const scenes::Mesh& m) {
              std::vector<glm::vec4> uvs;
              for (const glm::vec2& uv : m.uv0) uvs.emplace_back(uv, glm::vec2(0));
              return uvs;
            }));
}

// Image 0 is read as colour by one material and as data by another; image 1 as colour by both; image 2 by one that is
// not placed, image 3 by a slot that an unlit material does not read.
TEST_F(UploadTest, AnImageIsDoneWithWhenTheLastOfItsUsesIsUploaded) {
  scenes::Scene scene = tests::makeQuadScene();
  for (int i = 0; i < 4; ++i) scene.images.push_back({"image", base::Image8(5, 3, 4, 100)});
  scene.materials.resize(4);
  scene.materials[2].baseColorTexture.image = 2;
  scene.materials[3].unlit = true;
  scene.materials[3].normalTexture.image = 3;
  for (const std::uint32_t material : {1u, 3u}) {
    scene.meshes.push_back(tests::makeQuad(material));
    scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size() - 1), glm::mat4(1.f), "quad"});
  }
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].emissiveTexture.image = 1;
  scene.materials[1].baseColorTexture.image = 1;
  scene.materials[1].occlusionTexture.image = 0;
  std::vector<int> done;
  const Textures textures(device(), scene, false, [&](int image) {
    done.push_back(image);
    scene.images[static_cast<std::size_t>(image)].pixels = {};
  });
  const auto need = [&](std::size_t material, int slot) {
    const Textures::Need one{textures.setOfMaterial()[material], 1u << slot};
    textures.require(std::span(&one, 1));
  };
  EXPECT_EQ(done, (std::vector{2, 3}));
  done.clear();
  need(0, kSlotBaseColor);
  EXPECT_TRUE(done.empty()) << "it is still to be read as data";
  need(0, kSlotEmissive);
  EXPECT_EQ(done, std::vector{1});
  need(1, kSlotBaseColor); // is there
  need(1, kSlotOcclusion);
  EXPECT_EQ(done, (std::vector{1, 0}));
  EXPECT_EQ(textures.uploadedCount(), 3u);
  EXPECT_EQ(textures.bindings({textures.setOfMaterial()[1], 1u << kSlotOcclusion}).size(), std::size_t{kSlotCount});
}

// Image 0 is read as colour and as data, image 1 as a normal map with the spread of its normals.
TEST_F(UploadTest, ACodecIsGivenEachMipOfTheImageAsItIs) {
  scenes::Scene scene = tests::makeQuadScene();
  std::uint32_t state = 7;
  for (int i = 0; i < 2; ++i) {
    scene.images.push_back({"image", base::Image8(12, 5, 4)});
    for (std::uint8_t& value : scene.images[static_cast<std::size_t>(i)].pixels.pixels)
      value = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  }
  scene.materials[0].baseColorTexture.image = scene.materials[0].occlusionTexture.image = 0;
  scene.materials[0].normalTexture.image = 1;
  std::vector<std::pair<base::Image8, bool>> given;
  const Textures textures(device(), scene, true, {}, [&](const base::Image8& mip, bool isColor) {
    given.emplace_back(mip, isColor);
    return base::Image8(mip.width, mip.height, 4, 9); // what comes back does not reach the next mip
  });
  EXPECT_TRUE(textures.any());
  EXPECT_TRUE(given.empty()) << "the white ones have nothing to lose";
  const auto givenFor = [&](int slot) {
    given.clear();
    const Textures::Need need{textures.setOfMaterial()[0], 1u << slot};
    textures.require(std::span(&need, 1));
    return given;
  };
  for (const auto& [slot, isColor] : {std::pair(kSlotBaseColor, true), std::pair(kSlotOcclusion, false)}) {
    const std::vector<base::Image8> expected = tests::makeMips(scene.images[0].pixels, isColor);
    const auto mips = givenFor(slot);
    ASSERT_EQ(mips.size(), expected.size());
    for (std::size_t m = 0; m < mips.size(); ++m) {
      EXPECT_EQ(mips[m].first, expected[m]) << m;
      EXPECT_EQ(mips[m].second, isColor);
    }
  }
  const auto normals = givenFor(kSlotNormal);
  ASSERT_EQ(normals.size(), 4u);
  EXPECT_EQ(normals[0].first.at(0, 0)[3], 0) << "no spread";
  EXPECT_GT(normals[1].first.at(0, 0)[3], 0) << "the spread is stored, so it is compressed, too";
  EXPECT_FALSE(Textures(device(), tests::makeQuadScene(), false).any());
}

} // namespace
} // namespace parity::gpu
