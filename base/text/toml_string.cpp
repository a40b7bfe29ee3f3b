#include "base/text/toml_string.h"

#include <fmt/format.h>

#include "base/text/text.h"

namespace parity::base {

std::string tomlString(std::string_view text) {
  std::string out = "\"";
  for (const char c : cleanUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + "\"";
}

} // namespace parity::base
