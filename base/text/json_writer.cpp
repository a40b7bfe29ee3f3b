// JSON (RFC 8259) written as it comes.
#include "base/text/json_writer.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "base/text/text.h"

namespace parity::base {

namespace {

constexpr std::size_t kPiece = 64 * 1024; // bytes that a sink gets at once

} // namespace

void JsonWriter::beforeValue() {
  if (m_sink && m_out.size() >= kPiece) {
    m_sink(m_out);
    m_out.clear();
  }
  if (m_afterKey) {
    m_afterKey = false;
    return;
  }
  if (m_filled.empty()) return;
  if (m_filled.back()) m_out += ',';
  m_filled.back() = true;
  breakLine();
}

void JsonWriter::breakLine() {
  if (m_layout == JsonLayout::compact) return;
  m_out += '\n';
  m_out.append(2 * m_filled.size(), ' ');
}

void JsonWriter::begin(char bracket) {
  beforeValue();
  m_out += bracket;
  m_filled.push_back(false);
}

void JsonWriter::end(char bracket) {
  assert(!m_filled.empty() && !m_afterKey);
  const bool filled = m_filled.back();
  m_filled.pop_back();
  if (filled) breakLine();
  m_out += bracket;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  beforeValue();
  appendQuoted(name);
  m_out += m_layout == JsonLayout::compact ? ":" : ": ";
  m_afterKey = true;
  return *this;
}

void JsonWriter::raw(std::string_view value) {
  beforeValue();
  m_out += value;
}

void JsonWriter::text(std::string_view value) {
  beforeValue();
  appendQuoted(value);
}

void JsonWriter::number(double value) {
  if (!std::isfinite(value)) return null();
  std::array<char, 32> digits; // the shortest form of a double has at most 24 characters
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  raw({digits.data(), result.ptr});
}

void JsonWriter::appendQuoted(std::string_view value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  m_out += '"';
  for (const char c : cleanUtf8(value)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (m_out += '\\') += c;
    else if (byte < 0x20)
      (m_out += "\\u00").append({kDigits[byte >> 4], kDigits[byte & 15]});
    else
      m_out += c;
  }
  m_out += '"';
}

std::string JsonWriter::finish() {
  assert(m_filled.empty() && !m_afterKey);
  m_out += '\n';
  if (!m_sink) return std::move(m_out);
  m_sink(m_out);
  return {};
}

} // namespace parity::base
