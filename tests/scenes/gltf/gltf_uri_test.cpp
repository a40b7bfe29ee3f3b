// What a uri may name.
#include <fstream>
#include <stdexcept>

#include "scenes/gltf/file/uri.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {
namespace {

using scenes::decodeDataUri;
using scenes::resolveUri;

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(GltfUri, DecodesDataUris) {
  EXPECT_EQ(textOf(decodeDataUri("data:;base64,TWFu")), "Man"); // RFC 4648
  EXPECT_EQ(textOf(decodeDataUri("data:image/png;base64,TWE=")), "Ma");
  EXPECT_EQ(textOf(decodeDataUri("data:;base64,TQ==")), "M");
  EXPECT_EQ(textOf(decodeDataUri("data:;base64,TQ")), "M") << "padding may be left out";
  EXPECT_EQ(textOf(decodeDataUri("data:text/plain,a%20b%2")), "a b%2");
  EXPECT_EQ(textOf(decodeDataUri("data:;base64,")), "");
  for (const char* bad : {"data:;base64,T", "data:;base64,T W=", "data:;base64", "data:;base64,TQ=x",
                          "data:;;base64,TWFu", "data:image/png;;base64,TWFu"})
    EXPECT_THROW(decodeDataUri(bad), std::invalid_argument) << bad;
}

TEST(GltfUri, RoundTripsEveryByte) {
  std::vector<std::byte> all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<std::byte>(i));
  for (std::size_t length = 0; length <= all.size(); ++length) {
    const std::vector<std::byte> part(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_EQ(decodeDataUri("data:;base64," + encodeBase64(part)), part);
  }
}

TEST(GltfUri, ResolvesFilesOfTheFolderOnly) {
  const TempFolder folder;
  const std::filesystem::path root = std::filesystem::canonical(folder.path());
  EXPECT_EQ(resolveUri(root, "a.bin"), root / "a.bin");
  EXPECT_EQ(resolveUri(root, "maps/../a%20b.bin"), root / "a b.bin");
  EXPECT_EQ(resolveUri(root, "./x/./y.png"), root / "x" / "y.png");
  EXPECT_EQ(resolveUri(root, "100%.png"), root / "100%.png") << "a lone % stands for itself";
  for (const char* bad : {"", "../a", "x/../../a", "/a", "%2Fa", "..%2fa", "%2e%2e/a", "http://h/a", "C:/a", "C%3A/a",
                          "a\\b", "..\\a", "a%5Cb", "a%00b", "a\nb"})
    EXPECT_THROW(resolveUri(root, bad), std::invalid_argument) << bad;
}

TEST(GltfUri, FollowsLinksWithinTheFolderButNotOutOfIt) {
  const TempFolder folder, outside;
  const std::filesystem::path root = std::filesystem::canonical(folder.path());
  std::ofstream(folder / "real.bin") << "x";
  std::ofstream(outside / "other.bin") << "x";
  std::filesystem::create_symlink("real.bin", folder / "link.bin");
  std::filesystem::create_directory_symlink(outside.path(), folder / "maps");
  EXPECT_EQ(resolveUri(root, "link.bin"), root / "real.bin");
  EXPECT_THROW(resolveUri(root, "maps/other.bin"), std::invalid_argument);
  EXPECT_THROW(resolveUri(root, "maps/absent.bin"), std::invalid_argument);
}

TEST(GltfUri, KeepsMessagesShort) {
  const TempFolder folder;
  try {
    resolveUri(std::filesystem::canonical(folder.path()), "/" + std::string(100000, 'a'));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_LT(std::string(error.what()).size(), 200u);
  }
}

} // namespace
} // namespace parity::tests
