// Small sound pictures that carry an ICC profile, made by hand.
#include "profiled_images.h"

#include <array>
#include <span>
#include <stdexcept>

#include <webp/encode.h>
#include <zlib.h>

#include "png_bytes.h"

namespace parity::base {

namespace {

std::vector<std::byte> toBytes(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string littleEndian(std::uint32_t value, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string bigEndian(std::uint32_t value, int count) {
  const std::string text = littleEndian(value, count);
  return {text.rbegin(), text.rend()};
}

// 8 x 8 grey pixels: one block whose only coefficient is 0 (ITU-T T.81: tables of one code each). The profile stands in
// a segment APP2 (ICC.1:2010, B.4).
std::string makeJpeg(const std::string& profile) {
  std::string text = "\xff\xd8";
  if (!profile.empty()) {
    const std::string segment = std::string("ICC_PROFILE\0\1\1", 14) + profile;
    text += "\xff\xe2" + bigEndian(static_cast<std::uint32_t>(segment.size()) + 2, 2) + segment;
  }
  text += "\xff\xdb" + std::string("\0\x43\0", 3) + std::string(64, '\1');
  text += std::string("\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0", 13);
  for (const char table : {'\x00', '\x10'}) {
    text += std::string("\xff\xc4\0\x14", 4) + table + '\1';
    text += std::string(16, '\0');
  }
  return text + std::string("\xff\xda\0\x08\1\1\0\0\x3f\0\x3f\xff\xd9", 13);
}

std::vector<std::byte> makeProfiledPng(const std::string& profile) {
  const std::vector<std::uint8_t> samples(12, 0);
  if (profile.empty()) return makePng({.width = 2, .height = 2}, samples);
  uLongf size = compressBound(profile.size());
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(profile.data()),
               profile.size()) != Z_OK)
    throw std::runtime_error("zlib refused");
  packed.resize(size);
  return makePng({.width = 2, .height = 2}, samples, makePngChunk("iCCP", std::string("x\0\0", 3) + packed));
}

// TIFF 6.0, 2 x 2 pixels of RGB in one strip; the profile is the value of the tag 34675.
std::string makeTiff(const std::string& profile) {
  constexpr std::uint32_t kShort = 3, kLong = 4, kUndefined = 7, kEntryBytes = 12, kSamples = 12;
  struct Entry {
    std::uint32_t tag, type, count, value;
  };
  const std::uint32_t entries = profile.empty() ? 9 : 10, pixels = 8 + 2 + kEntryBytes * entries + 4;
  std::vector<Entry> all = {{256, kLong, 1, 2},  {257, kLong, 1, 2},  {258, kShort, 1, 8},
                            {259, kShort, 1, 1}, {262, kShort, 1, 2}, {273, kLong, 1, pixels},
                            {277, kShort, 1, 3}, {278, kLong, 1, 2},  {279, kLong, 1, kSamples}};
  if (!profile.empty())
    all.push_back({34675, kUndefined, static_cast<std::uint32_t>(profile.size()), pixels + kSamples});
  std::string text = std::string("II*\0", 4) + littleEndian(8, 4) + littleEndian(entries, 2);
  for (const Entry& entry : all)
    text += littleEndian(entry.tag, 2) + littleEndian(entry.type, 2) + littleEndian(entry.count, 4) +
            littleEndian(entry.value, 4);
  return text + std::string(4 + kSamples, '\0') + profile;
}

// RFC 9649: the extended header says that a chunk ICCP follows.
std::string makeWebp(const std::string& profile) {
  const std::array<std::uint8_t, 4 * 4> rgba{};
  std::uint8_t* out = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 2, 2, 8, &out);
  if (size == 0) throw std::runtime_error("libwebp encodes nothing");
  const std::string plain(reinterpret_cast<const char*>(out), size);
  WebPFree(out);
  if (profile.empty()) return plain;
  const auto chunk = [](const std::string& name, const std::string& data) {
    return name + littleEndian(static_cast<std::uint32_t>(data.size()), 4) + data + std::string(data.size() % 2, '\0');
  };
  const std::string header = littleEndian(0x30, 4) + littleEndian(1, 3) + littleEndian(1, 3); // profile, alpha; 2 x 2
  const std::string body = "WEBP" + chunk("VP8X", header) + chunk("ICCP", profile) + plain.substr(12);
  return "RIFF" + littleEndian(static_cast<std::uint32_t>(body.size()), 4) + body;
}

} // namespace

std::string makeIccProfile(const std::string& tag, std::uint32_t offset, std::uint32_t size, const std::string& value) {
  const std::string table = bigEndian(1, 4) + tag + bigEndian(offset, 4) + bigEndian(size, 4);
  std::string header(128, '\0');
  header.replace(0, 4, bigEndian(static_cast<std::uint32_t>(128 + table.size() + value.size()), 4));
  header.replace(4, 4, "made");
  header.replace(8, 4, bigEndian(0x02400000, 4));
  header.replace(12, 12, "mntrRGB XYZ ");
  header.replace(36, 4, "acsp");
  return header + table + value;
}

std::vector<std::string> makeWrappingProfiles() {
  std::vector<std::string> profiles;
  for (const char* tag : {"cprt", "desc", "dmnd", "dmdd", "wtpt"})
    for (const auto& [offset, size] : std::initializer_list<std::pair<std::uint32_t, std::uint32_t>>{
             {0xfffffff0, 0x20}, {0x80000000, 0x80000010}, {0xc0000000, 0x40000001}, {0xffffffff, 0x10}, {144, ~0u}})
      profiles.push_back(makeIccProfile(tag, offset, size, "text" + std::string(20, 'a')));
  return profiles;
}

std::map<std::string, std::vector<std::byte>> makeProfiledImages(const std::string& profile) {
  return {{"a.jpg", toBytes(makeJpeg(profile))},
          {"a.png", makeProfiledPng(profile)},
          {"a.tif", toBytes(makeTiff(profile))},
          {"a.webp", toBytes(makeWebp(profile))}};
}

} // namespace parity::base
