#include "paths/preset/preset_function.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

namespace parity::paths {

namespace {

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// The identifier that ends before `end`, blanks skipped.
std::string_view wordBefore(std::string_view text, std::size_t end) {
  while (end > 0 && std::isspace(static_cast<unsigned char>(text[end - 1])) != 0) --end;
  std::size_t begin = end;
  while (begin > 0 && isLetter(text[begin - 1])) --begin;
  return text.substr(begin, end - begin);
}

} // namespace

std::string withoutComments(std::string_view text) {
  std::string plain(text);
  const auto blank = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (plain[i] != '\n') plain[i] = ' ';
  };
  bool startsLine = true;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("//") || (startsLine && rest.starts_with("#"))) {
      std::size_t end = std::min(text.find('\n', i), text.size());
      while (end < text.size() && end > 0 && text[end - 1] == '\\')
        end = std::min(text.find('\n', end + 1), text.size());
      blank(i, end);
      i = end;
    } else if (rest.starts_with("/*")) {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
      blank(i, end);
      i = end - 1;
    }
    if (i >= plain.size()) break;
    if (plain[i] == '\n')
      startsLine = true;
    else if (std::isspace(static_cast<unsigned char>(plain[i])) == 0)
      startsLine = false;
  }
  return plain;
}

std::vector<PresetFunction> presetFunctionsOf(std::string_view declarations) {
  constexpr std::string_view kMacro = "#ifdef PARITY_OWN_";
  std::vector<PresetFunction> all;
  std::istringstream lines{std::string(declarations)};
  std::string words;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("//")) {
      words += line.substr(std::min<std::size_t>(line.size(), 3)) + "\n";
      continue;
    }
    if (line.starts_with(kMacro)) {
      PresetFunction function{.name = line.substr(kMacro.size()), .prototype = {}, .words = std::move(words)};
      std::getline(lines, function.prototype);
      all.push_back(std::move(function));
    }
    words.clear();
  }
  return all;
}

std::vector<std::string> includesOf(std::string_view glsl) {
  static const std::regex include(R"(^[ \t]*#[ \t]*include[ \t]*["<]([^">\n]*)[">])", std::regex::multiline);
  const std::string text(glsl);
  std::vector<std::string> paths;
  for (std::sregex_iterator found(text.begin(), text.end(), include), end; found != end; ++found)
    paths.push_back((*found)[1]);
  return paths;
}

std::vector<DefinedFunction> definedFunctionsOf(std::string_view glsl) {
  const std::string plain = withoutComments(glsl);
  std::vector<DefinedFunction> all;
  std::size_t depth = 0, parameters = std::string::npos; // where the last list of parameters at depth 0 begins
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '(' && depth == 0) {
      parameters = i;
      while (i < plain.size() && plain[i] != ')') ++i;
    } else if (c == '{') {
      if (depth++ == 0 && parameters != std::string::npos)
        all.push_back(
            {std::string(wordBefore(plain, parameters)),
             static_cast<std::size_t>(std::count(plain.begin(), plain.begin() + static_cast<long>(parameters), '\n')) +
                 1});
      parameters = std::string::npos;
    } else if (c == '}' && depth > 0) {
      --depth;
    } else if (c == ';' && depth == 0) {
      parameters = std::string::npos;
    }
  }
  return all;
}

} // namespace parity::paths
