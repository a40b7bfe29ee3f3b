#include "base/text/wrap.h"

#include <vector>

#include "base/text/text.h"
#include "base/text/utf8.h"

namespace parity::base {
namespace {

// The words of a line; of a command those of its shell.
std::vector<std::string_view> split(std::string_view text, bool isCommand) {
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  bool isQuoted = false;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const bool isEnd = at == text.size();
    if (!isEnd && isCommand && text[at] == '\'') isQuoted = !isQuoted;
    if (!isEnd && isCommand && text[at] == '\\' && !isQuoted && at + 1 < text.size()) {
      ++at;
      continue;
    }
    if (!isEnd && (isQuoted || text[at] != ' ')) continue;
    if (at > begin) words.push_back(text.substr(begin, at - begin));
    begin = at + 1;
  }
  return words;
}

class Lines {
public:
  Lines(std::size_t columns, std::size_t used, std::size_t indent, std::string end)
      : m_columns(columns), m_used(used), m_indent(indent), m_end(std::move(end)) {}

  void addWord(std::string_view word, bool mayBreak) {
    const std::size_t width = displayWidth(word), space = m_isAtStart ? 0 : 1;
    if (!m_isAtStart && m_used + space + width > m_columns) startLine();
    if (mayBreak && m_used + width > m_columns && m_isAtStart) return addLetters(word);
    if (!m_isAtStart) m_out += ' ', ++m_used;
    m_out += word;
    m_used += width;
    m_isAtStart = false;
  }
  std::string take() { return std::move(m_out); }

private:
  void startLine() {
    m_out += m_end + "\n" + std::string(m_indent, ' ');
    m_used = m_indent;
    m_isAtStart = true;
  }
  void addLetters(std::string_view word) {
    forEachCode(word, [&](std::uint32_t code) {
      std::string letter;
      appendUtf8(letter, code);
      const std::size_t width = displayWidth(letter);
      if (m_used + width > m_columns) startLine();
      m_out += letter;
      m_used += width;
      m_isAtStart = false;
    });
  }

  std::size_t m_columns, m_used, m_indent;
  std::string m_end, m_out;
  bool m_isAtStart = true;
};

} // namespace

std::string wrapText(std::string_view text, std::size_t columns, std::size_t used, std::size_t indent) {
  if (columns == 0 || used + displayWidth(text) <= columns) return std::string(text);
  Lines lines(columns, used, indent, "");
  for (const std::string_view word : split(text, false)) lines.addWord(word, true);
  return lines.take();
}

std::string wrapCommand(std::string_view command, std::size_t columns, std::size_t indent) {
  const std::string begin(indent, ' ');
  if (columns == 0 || indent + displayWidth(command) <= columns) return begin + std::string(command);
  Lines lines(columns - 2, indent, indent + 4, " \\"); // " \" fits behind every line
  for (const std::string_view word : split(command, true)) lines.addWord(word, false);
  return begin + lines.take();
}

} // namespace parity::base
