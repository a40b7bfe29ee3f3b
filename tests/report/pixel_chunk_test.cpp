// Pixel files read back by a decoder of the test's own: zlib, and base64 digit by digit.
#include "report/pixel_chunk.h"

#include <zlib.h>

#include <bit>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/simd_level.h"
#include "report/base64.h"
#include "report/pixel_row.h"
#include "shading/half.h"

namespace parity::report {
namespace {

std::string fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0u);
  std::string out;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((held += 6) < 8) continue;
    held -= 8;
    out += static_cast<char>(bits >> held & 255);
  }
  return out;
}

std::vector<std::uint8_t> inflateRaw(const std::string& data, std::size_t most) {
  std::vector<std::uint8_t> out(most + 1); // one more, so that a longer stream shows
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_LE(stream.total_out, most);
  EXPECT_EQ(stream.avail_in, 0u);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

// The 16-bit values of each channel, row by row.
std::vector<std::uint16_t> decode(const std::string& base64, int width, int height, int channels) {
  const auto count = static_cast<std::size_t>(width * height), all = static_cast<std::size_t>(channels);
  const std::size_t bits = (count + 7) / 8;
  const auto bytes = inflateRaw(fromBase64(base64), bits + 2 * count * all);
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < 8 * bits; ++i)
    if (bytes.at(i / 8) >> i % 8 & 1) changed.push_back(i);
  EXPECT_TRUE(changed.empty() || changed.back() < count);
  EXPECT_EQ(bytes.size(), bits + 2 * changed.size() * all);
  std::vector<std::uint16_t> values(count * all);
  for (std::size_t c = 0; c < all; ++c) {
    const std::uint8_t* low = bytes.data() + bits + 2 * changed.size() * c;
    std::size_t next = 0;
    unsigned value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (next < changed.size() && changed[next] == i) {
        value += low[next] + 256u * low[changed.size() + next];
        ++next;
      }
      values[count * c + i] = static_cast<std::uint16_t>(value);
    }
  }
  return values;
}

// The bytes of a plane's stream.
std::size_t streamSize(const base::Image& image, PlaneKind kind) {
  const std::string data = fromBase64(encodePlane({"x", kind, &image}).data);
  return inflateRaw(data, image.pixelCount() / 8 + 1 + 2 * image.pixels.size()).size();
}

std::vector<std::uint16_t> roundTrip(const base::Image& image, PlaneKind kind) {
  return decode(encodePlane({"x", kind, &image}).data, image.width, image.height, image.channels);
}

TEST(PixelChunk, KeepsEveryHalf) {
  base::Image image(256, 256, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = shading::Half::fromBits(static_cast<std::uint16_t>(i / 3 + i % 3 * 20000));
  const std::vector<std::uint16_t> values = roundTrip(image, PlaneKind::rgb16f);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto bits = static_cast<std::uint16_t>(i / 3 + i % 3 * 20000);
    const bool isNan = (bits & 0x7fff) > 0x7c00;
    ASSERT_EQ(values[i % 3 * 65536 + i / 3], isNan ? 0x7e00 : bits) << "every NaN is one";
  }
}

TEST(PixelChunk, RoundsToTheNearestHalfAndKeepsWhatIsNotFinite) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<float, int>> expected = {{1.f, 0x3c00},
                                                       {-2.f, 0xc000},
                                                       {1 + 0x1p-11f, 0x3c00},
                                                       {1 + 0x1.8p-10f, 0x3c02},
                                                       {65504.f, 0x7bff},
                                                       {65519.f, 0x7bff},
                                                       {65520.f, 0x7bff},
                                                       {1e9f, 0x7bff},
                                                       {-1e9f, 0xfbff},
                                                       {kInf, 0x7c00},
                                                       {-kInf, 0xfc00},
                                                       {0x1p-24f, 0x0001},
                                                       {0x1p-25f, 0x0000},
                                                       {0x1.8p-24f, 0x0002},
                                                       {-0.f, 0x8000},
                                                       {std::nanf(""), 0x7e00},
                                                       {-std::nanf(""), 0x7e00},
                                                       {std::numeric_limits<float>::max(), 0x7bff}};
  base::Image image(static_cast<int>(expected.size()), 1, 3);
  for (std::size_t i = 0; i < expected.size(); ++i) image.pixels[3 * i + 1] = expected[i].first;
  const std::vector<std::uint16_t> values = roundTrip(image, PlaneKind::rgb16f);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(values[expected.size() + i], expected[i].second) << expected[i].first;
}

TEST(PixelChunk, AnySizeComesBackInItsOrder) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> value(-100, 100);
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {1, 9}, {9, 1}, {7, 5}, {33, 31}}) {
    base::Image image(width, height, 3);
    for (float& v : image.pixels) v = value(engine);
    const std::vector<std::uint16_t> values = roundTrip(image, PlaneKind::rgb16f);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_EQ(values[i % 3 * image.pixelCount() + i / 3], shading::Half(image.pixels[i]).bits())
          << width << " x " << height;
  }
}

// Against shading::Half, which rounds by another way (in double).
TEST(PixelChunk, RoundsAnyFloatAsHalvesDo) {
  std::mt19937 engine(3);
  base::Image image(1024, 256, 3);
  for (float& v : image.pixels) do
      v = std::bit_cast<float>(static_cast<std::uint32_t>(engine()));
    while (!(std::abs(v) <= 65504));
  for (std::size_t i = 0; i < image.pixels.size(); i += 2) // at the halves' own scale, with many ties
    image.pixels[i] =
        std::ldexp(static_cast<float>(static_cast<int>(engine() % 8192) - 4096), static_cast<int>(engine() % 30) - 26);
  const std::vector<std::uint16_t> values = roundTrip(image, PlaneKind::rgb16f);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_EQ(values[i % 3 * image.pixelCount() + i / 3], shading::Half(image.pixels[i]).bits()) << image.pixels[i];
}

// A pixel that differs in one channel alone is stored, and one like the pixel before it is not, also across rows.
TEST(PixelChunk, StoresThePixelsThatDifferFromTheOneBefore) {
  base::Image image(5, 3, 3, 2.f);
  EXPECT_EQ(streamSize(image, PlaneKind::rgb16f), 2u + 6u) << "the first differs from 0";
  for (std::size_t c = 0; c < 3; ++c) {
    base::Image other = image;
    other.pixels[3 * 9 + c] = 1; // the last of the second row; the next one differs from it
    EXPECT_EQ(streamSize(other, PlaneKind::rgb16f), 2u + 3 * 6u) << c;
    const std::vector<std::uint16_t> values = roundTrip(other, PlaneKind::rgb16f);
    for (std::size_t i = 0; i < other.pixels.size(); ++i)
      ASSERT_EQ(values[i % 3 * 15 + i / 3], shading::Half(other.pixels[i]).bits()) << c << " " << i;
  }
  const base::Image black(5, 3, 1, 0.f);
  EXPECT_EQ(streamSize(black, PlaneKind::unorm16), 2u);
  EXPECT_EQ(roundTrip(black, PlaneKind::unorm16), std::vector<std::uint16_t>(15, 0));
}

// Rows of every length up to several vectors, so that each instruction set also meets what is left of one.
TEST(PixelChunk, EveryInstructionSetGivesTheSameBits) {
  struct BestAgain {
    ~BestAgain() { base::useSimdLevel(""); }
  } const again;
  std::mt19937 engine(5);
  std::vector<float> values(131);
  for (float& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(engine()));
  values[3] = std::nanf(""), values[70] = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < values.size(); i += 3) values[i] = static_cast<float>(engine()) * 0x1p-32f;
  for (const PlaneKind kind : {PlaneKind::rgb16f, PlaneKind::unorm16, PlaneKind::uint16})
    for (std::size_t count = 0; count <= values.size(); ++count) {
      std::vector<std::uint16_t> expected;
      for (const std::string& level : base::simdLevels()) {
        base::useSimdLevel(level);
        std::vector<std::uint16_t> packed(count);
        packRow(std::span(values).first(count), kind, packed);
        if (expected.empty()) expected = packed;
        ASSERT_EQ(packed, expected) << level << " " << count;
      }
    }
}

TEST(PixelChunk, SharesAndNumbersAreSixteenBits) {
  base::Image image(5, 2, 1);
  image.pixels = {0, 1, 0.5f, -1, 2, std::nanf(""), 1 / 65535.f, 0.4f / 65535, 0.6f / 65535, 0.25f};
  EXPECT_EQ(roundTrip(image, PlaneKind::unorm16),
            (std::vector<std::uint16_t>{0, 65535, 32768, 0, 65535, 65535, 1, 0, 1, 16384}));
  image.pixels = {0, 1, 2, 65535, 65534, 65535.75f, -3, 300, 255, 70000};
  EXPECT_EQ(roundTrip(image, PlaneKind::uint16),
            (std::vector<std::uint16_t>{0, 1, 2, 65535, 65534, 65535, 0, 300, 255, 65535}));
}

TEST(PixelChunk, IsAStatementAroundAnObject) {
  base::Image color(2, 3, 3, 0.25f), flip(2, 3, 1, 1.f);
  const EncodedPlane planes[] = {encodePlane({"highend", PlaneKind::rgb16f, &color}),
                                 encodePlane({"flip", PlaneKind::unorm16, &flip})};
  const std::pair<std::string_view, int> members[] = {{"minLog2", -12}};
  std::vector<std::byte> chunk = makeChunk("pixels/0-a_0-b.js", 2, 3, planes, members);
  const auto textOf = [](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string object(chunkObject(chunk));
  EXPECT_EQ(textOf(chunk), "parityChunk(" + object + ");\n");
  nlohmann::json parsed = nlohmann::json::parse(object);
  EXPECT_EQ(parsed["file"], "pixels/0-a_0-b.js");
  EXPECT_EQ(parsed["format"], 2);
  EXPECT_EQ(parsed["width"], 2);
  EXPECT_EQ(parsed["height"], 3);
  EXPECT_EQ(parsed["minLog2"], -12);
  ASSERT_EQ(parsed["planes"].size(), 2u);
  EXPECT_EQ(parsed["planes"][0]["name"], "highend");
  EXPECT_EQ(parsed["planes"][0]["kind"], "rgb16f");
  EXPECT_EQ(parsed["planes"][1]["kind"], "unorm16");
  EXPECT_EQ(decode(parsed["planes"][1]["data"], 2, 3, 1), std::vector<std::uint16_t>(6, 65535));

  for (const char* name : {"pixels/12-another-scene_3-longer.js", "pixels/1.js"}) {
    renameChunk(chunk, name);
    parsed["file"] = name;
    EXPECT_EQ(nlohmann::json::parse(chunkObject(chunk)), parsed);
    EXPECT_EQ(textOf(chunk), textOf(makeChunk(name, 2, 3, planes, members)));
  }
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  const auto encode = [](std::string_view text) { return toBase64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foob"), "Zm9vYg==");
  EXPECT_EQ(encode("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encode("\xff\xef\xbe"), "/+++");
}

} // namespace
} // namespace parity::report
