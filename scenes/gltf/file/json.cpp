// The JSON of a glTF file: parsed with limits.
#include "scenes/gltf/file/json.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/error_words.h"

namespace parity::scenes {
namespace {

// One pass over the text, aware of strings only: counts nesting and separators before anything is allocated.
void checkLimits(std::string_view text, const std::string& label) {
  int depth = 0;
  std::size_t values = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inString = false;
      continue;
    }
    if (c == '"')
      inString = true;
    else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth)
        throw base::fileError(label, "JSON", fmt::format("is nested deeper than {} levels", kMaxJsonDepth));
      ++values;
    } else if (c == '}' || c == ']')
      --depth;
    else if (c == ',' || c == ':')
      ++values;
    if (values > kMaxJsonValues)
      throw base::fileError(label, "JSON", fmt::format("has more than {} values", kMaxJsonValues));
  }
}

} // namespace

nlohmann::json parseGltfJson(std::string_view text, const std::string& label) {
  // Of a file of another kind the place where it stops being JSON says nothing.
  std::string ending = std::filesystem::path(label).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".gltf" && ending != ".glb" && !text.starts_with('{'))
    throw base::fileError(label, "",
                          ending == ".toml" ? "is not a glTF scene; give a suite with --suite"
                                            : "is not a glTF scene (.gltf or .glb)");
  checkLimits(text, label);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    // "parse error at line 3, column 7: syntax error ..."
    const std::string told = base::wordsOf(error);
    std::string_view reason = told;
    constexpr std::string_view kPrefix = "parse error at ";
    if (reason.starts_with(kPrefix)) reason.remove_prefix(kPrefix.size());
    std::string words(reason.substr(0, 300));
    for (char& c : words) // it quotes the file, whose bytes may be no text at all
      if (static_cast<unsigned char>(c) >= 0x7f) c = '?';
    throw base::fileError(label, "JSON", words);
  }
}

} // namespace parity::scenes
