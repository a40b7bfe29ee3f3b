// What a uri in a glTF file may name.
#include "scenes/gltf/file/uri.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

// As in a message: short, so that a megabyte of uri stays one line.
std::string quote(std::string_view uri) {
  return fmt::format("'{}{}'", uri.substr(0, 80), uri.size() > 80 ? "..." : "");
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// A '%' that no two hexadecimal digits follow stands for itself: exporters write file names as they are.
std::string decodePercent(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        out += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    out += text[i];
  }
  return out;
}

// RFC 4648, section 4, with or without padding; nothing but the alphabet.
std::vector<std::byte> decodeBase64(std::string_view text) {
  static constexpr auto kValues = [] {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
      values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    return values;
  }();
  for (int pad = 0; pad < 2 && text.ends_with('='); ++pad) text.remove_suffix(1);
  if (text.size() % 4 == 1) throw std::invalid_argument("base64 data is truncated");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) throw std::invalid_argument("base64 data holds an invalid character");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if (count += 6; count >= 8) bytes.push_back(static_cast<std::byte>(bits >> (count -= 8) & 0xff));
  }
  return bytes;
}

bool hasScheme(std::string_view uri) {
  const auto colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  const auto isAlpha = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return isAlpha(uri[0]) && std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [&](char c) {
           return isAlpha(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
         });
}

bool isWithin(const std::filesystem::path& folder, const std::filesystem::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

} // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

std::vector<std::byte> decodeDataUri(std::string_view uri) {
  const auto comma = uri.find(',');
  if (!isDataUri(uri) || comma == std::string_view::npos)
    throw std::invalid_argument("is a data uri without the comma before its data");
  if (const std::string_view head = uri.substr(0, comma); head.find(";;") != std::string_view::npos)
    throw std::invalid_argument(quote(head) + " is not a data uri: a parameter is empty (';;')");
  const std::string_view data = uri.substr(comma + 1);
  if (uri.substr(0, comma).ends_with(";base64")) return decodeBase64(data);
  const std::string text = decodePercent(data);
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

std::filesystem::path resolveUri(const std::filesystem::path& folder, std::string_view uri) {
  // Checked twice: as written, and as decoded, for what percent-encoding may hide.
  const std::string decoded = decodePercent(uri);
  for (const std::string_view form : {uri, std::string_view(decoded)}) {
    if (form.empty()) throw std::invalid_argument("is an empty uri");
    if (hasScheme(form))
      throw std::invalid_argument(quote(uri) + " has a scheme; only data: and files in the asset's folder are read");
    if (form.front() == '/')
      throw std::invalid_argument(quote(uri) + " is absolute; only files in the asset's folder are read");
    if (std::any_of(form.begin(), form.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
      throw std::invalid_argument(quote(uri) + " holds a control character");
    if (form.find('\\') != std::string_view::npos)
      throw std::invalid_argument(quote(uri) + " holds a backslash; uris use '/'");
    int depth = 0;
    for (const auto& part : std::filesystem::path(form)) {
      if (part == "..")
        --depth;
      else if (part != "." && !part.empty())
        ++depth;
      if (depth < 0) throw std::invalid_argument(quote(uri) + " points outside the asset's folder");
    }
  }
  std::error_code failed;
  std::filesystem::path file = std::filesystem::weakly_canonical(folder / decoded, failed);
  if (failed) throw std::invalid_argument(quote(uri) + " cannot be found: " + failed.message());
  if (!isWithin(folder, file))
    throw std::invalid_argument(quote(uri) + " points outside the asset's folder through a symbolic link");
  return file;
}

std::filesystem::path nameOfUri(const std::filesystem::path& folder, std::string_view uri) {
  return folder / decodePercent(uri);
}

} // namespace parity::scenes
