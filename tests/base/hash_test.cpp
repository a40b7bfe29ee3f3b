// The content hash: known answers, and no dependence on how the bytes come in.
#include "base/hash.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace parity::base {
namespace {

std::vector<std::byte> makeBytes(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 31 + (i >> 8));
  return bytes;
}

std::string hashOf(std::span<const std::byte> bytes) { return Hasher().add(bytes).hex(); }

TEST(Hasher, GivesTheAnswersOfTheLibrary) {
  // Nothing, "a" and "abc" by XXH3_128bits, the one-shot function of the compiled libxxhash 0.8.1.
  const auto bytesOf = [](const char* text) { return std::as_bytes(std::span{text, std::string(text).size()}); };
  EXPECT_EQ(hashOf({}), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hashOf(bytesOf("a")), "a96faf705af16834e6c632b61e964e1f");
  EXPECT_EQ(hashOf(bytesOf("abc")), "06b05ab6733a618578af5f94892f3950");
}

TEST(Hasher, DoesNotDependOnHowTheBytesAreSplit) {
  const std::vector<std::byte> bytes = makeBytes(5000);
  const std::string expected = hashOf(bytes);
  for (const std::size_t step : {1, 7, 240, 256, 1024, 4999}) {
    Hasher hasher;
    for (std::size_t i = 0; i < bytes.size(); i += step)
      hasher.add(std::span{bytes}.subspan(i, std::min(step, bytes.size() - i)));
    EXPECT_EQ(hasher.hex(), expected) << "steps of " << step;
  }
}

TEST(Hasher, NoticesOneBitAnywhere) {
  std::vector<std::byte> bytes = makeBytes(600);
  const std::string before = hashOf(bytes);
  for (const std::size_t at : {0, 100, 599}) {
    bytes[at] ^= std::byte{1};
    EXPECT_NE(hashOf(bytes), before) << at;
    bytes[at] ^= std::byte{1};
  }
  EXPECT_EQ(hashOf(bytes), before);
}

TEST(Hasher, TellsWhereOneTextEndsAndTheNextBegins) {
  EXPECT_NE(Hasher().add("a").add("bc").hex(), Hasher().add("ab").add("c").hex());
  EXPECT_NE(Hasher().add("").hex(), Hasher().hex());
}

TEST(Hasher, TakesValuesByTheirBytes) {
  const float value = 1.5f;
  EXPECT_EQ(Hasher().addValue(value).hex(), hashOf(std::as_bytes(std::span{&value, 1})));
  EXPECT_NE(Hasher().addValue(0.0f).hex(), Hasher().addValue(-0.0f).hex());
}

TEST(Hasher, CanBeAskedInBetween) {
  Hasher hasher;
  hasher.add("a");
  const std::string first = hasher.hex();
  EXPECT_EQ(hasher.hex(), first);
  EXPECT_EQ(hasher.add("b").hex(), Hasher().add("a").add("b").hex());
}

} // namespace
} // namespace parity::base
