// OpenEXR headers that ask for more than their file justifies are refused before the library sees them.
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/exr_check.h"
#include "base/image/image_io.h"
#include "expect_error.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

std::vector<std::byte> writeExr() {
  const TempFolder folder;
  writeImage(folder / "a.exr", Image(8, 4, 3, 0.5f));
  return readFile(folder / "a.exr");
}

// Overwrites 32 bits, `offset` bytes behind the type of the attribute's value.
void patch(std::vector<std::byte>& bytes, const std::string& attribute, const std::string& type, std::size_t offset,
           std::int32_t value) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string key = attribute + '\0' + type + '\0';
  const std::size_t at = text.find(key);
  ASSERT_NE(at, std::string_view::npos) << attribute;
  std::memcpy(bytes.data() + at + key.size() + offset, &value, sizeof(value));
}

void check(const std::vector<std::byte>& bytes) { checkExr(bytes, bytes.size(), "a.exr"); }

TEST(ExrCheck, LetsSoundFilesPassWholeAndByTheirHead) {
  const std::vector<std::byte> bytes = writeExr();
  check(bytes);
  for (std::size_t head = 0; head < bytes.size(); ++head) checkExr(std::span(bytes).first(head), bytes.size(), "a.exr");
  EXPECT_EQ(decodeRadiance(bytes, "a.exr").pixels, Image(8, 4, 3, 0.5f));
}

TEST(ExrCheck, RefusesAttributesLargerThanTheFile) {
  std::vector<std::byte> bytes = writeExr();
  patch(bytes, "compression", "compression", 0, 1694498816);
  expectError([&] { check(bytes); }, "a.exr", "an attribute has 1694498816 bytes");
  patch(bytes, "compression", "compression", 0, -1);
  expectError([&] { check(bytes); }, "a.exr", "an attribute has -1 bytes");
  expectError([&] { decodeRadiance(bytes, "a.exr"); }, "a.exr", "an attribute has -1 bytes");
  const TempFolder folder;
  writeBytes(folder / "a.exr", bytes);
  expectError([&] { readImage(folder / "a.exr"); }, "a.exr", "an attribute has -1 bytes");
}

// The library reads as many bytes as the type has, not as many as there are.
TEST(ExrCheck, RefusesAttributesOfAnotherSizeThanTheirType) {
  std::vector<std::byte> bytes = writeExr();
  patch(bytes, "dataWindow", "box2i", 0, 15);
  expectError([&] { check(bytes); }, "a.exr", "an attribute of type box2i has 15 bytes, expected 16");
  expectError([&] { decodeRadiance(bytes, "a.exr"); }, "a.exr", "an attribute of type box2i has 15 bytes");
}

// The library reads channels up to an empty name, as many texels of a preview and as long strings as the value says.
TEST(ExrCheck, RefusesValuesThatDoNotEndWhereTheirAttributeDoes) {
  const auto number = [](std::int32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  const auto checkAttribute = [&](const std::string& type, const std::string& value) {
    const std::string text = std::string("\x76\x2f\x31\x01\x02\0\0\0", 8) + "some" + '\0' + type + '\0' +
                             number(static_cast<std::int32_t>(value.size())) + value + '\0';
    checkExr(std::as_bytes(std::span{text}), text.size(), "a.exr");
  };
  const std::string channel = std::string("R") + std::string(17, '\0');
  checkAttribute("chlist", channel + '\0');
  checkAttribute("preview", number(2) + number(1) + std::string(8, 'p'));
  checkAttribute("stringvector", number(3) + "abc" + number(0));
  for (const auto& [type, value] : std::initializer_list<std::pair<const char*, std::string>>{
           {"chlist", channel},
           {"chlist", channel + "G"},
           {"chlist", channel + '\0' + channel},
           {"chlist", ""},
           {"preview", number(2) + number(1) + std::string(7, 'p')},
           {"preview", number(65536) + number(65536)},
           {"preview", number(-1) + number(-2) + std::string(8, 'p')},
           {"preview", "x"},
           {"stringvector", number(2000000000) + "abc"},
           {"stringvector", number(-1)},
           {"stringvector", "abc"}})
    expectError([&] { checkAttribute(type, value); }, "a.exr", "does not match its content");
}

TEST(ExrCheck, RefusesWindowsBeyondTheLimits) {
  std::vector<std::byte> bytes = writeExr();
  patch(bytes, "dataWindow", "box2i", 4 + 8, 100000);
  expectError([&] { check(bytes); }, "a.exr", "the largest allowed side");
  patch(bytes, "dataWindow", "box2i", 4, -2147483647);
  patch(bytes, "dataWindow", "box2i", 4 + 8, 2147483647);
  expectError([&] { check(bytes); }, "a.exr", "the largest allowed side");
  patch(bytes, "dataWindow", "box2i", 4, 1);
  patch(bytes, "dataWindow", "box2i", 4 + 8, 0);
  expectError([&] { check(bytes); }, "a.exr", "has no pixels");
}

// A header of these channels, compression and tiles; nothing behind it.
std::vector<std::byte> makeHeader(int channels, char compression, int side, int tile) {
  std::string text("\x76\x2f\x31\x01\x02\0\0\0", 8), list;
  const auto number = [](std::int32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  const auto add = [&](const std::string& name, const std::string& type, const std::string& value) {
    text += name + '\0' + type + '\0' + number(static_cast<std::int32_t>(value.size())) + value;
  };
  for (int c = 0; c < channels; ++c) list += "c" + std::to_string(c) + '\0' + std::string(16, '\0');
  add("channels", "chlist", list + '\0');
  add("compression", "compression", std::string(1, compression));
  add("dataWindow", "box2i", number(0) + number(0) + number(side - 1) + number(side - 1));
  if (tile) add("tiles", "tiledesc", number(tile) + number(tile) + '\0');
  text += '\0';
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

TEST(ExrCheck, RefusesChunksThatAreTooLargeOrTooMany) {
  check(makeHeader(16, 9, 16384, 0)); // 16 x 256 lines of 16384 values of 4 bytes: 256 MiB
  expectError([] { check(makeHeader(17, 9, 16384, 0)); }, "a.exr", "17 channels of 4194304 texels");
  check(makeHeader(17, 0, 16384, 0)); // by single lines
  expectError([] { check(makeHeader(5, 0, 16384, 4096)); }, "a.exr", "5 channels of 16777216 texels");
  expectError([] { check(makeHeader(1, 0, 16384, 1)); }, "a.exr", "the image has 268435456 parts");
  expectError([] { check(makeHeader(1, 0, 16384, 100000)); }, "a.exr", "tiles of 100000 x 100000 pixels");
  expectError([] { check(makeHeader(1, 0, 16384, -5)); }, "a.exr", "tiles of -5 x -5 pixels");
}

} // namespace
} // namespace parity::base
