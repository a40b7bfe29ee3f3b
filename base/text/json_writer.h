// A small JSON writer: keys in the order of the calls, numbers in their shortest form that reads back the same.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/text_sink.h"

namespace parity::base {

enum class JsonLayout {
  indented, // by two spaces
  compact,  // no spaces, one line
};

// UTF-8 (invalid bytes become U+FFFD), "\n" line ends. Values that are not finite become null,
// which the schema allows where they can occur. (nlohmann's dump is not used here: its numbers are not always the
// shortest, so their text could change with its version.)
class JsonWriter {
public:
  // sink: gets the document in pieces of some ten kilobytes, each of whole values; empty: finish() returns it.
  explicit JsonWriter(JsonLayout layout = JsonLayout::indented, TextSink sink = {})
      : m_layout(layout), m_sink(std::move(sink)) {}

  void beginObject() { begin('{'); }
  void endObject() { end('}'); }
  void beginArray() { begin('['); }
  void endArray() { end(']'); }
  // The name of the next value; only inside an object.
  JsonWriter& key(std::string_view name);

  void text(std::string_view value);
  void number(double value);
  void integer(std::integral auto value) { raw(std::to_string(value)); }
  void boolean(bool value) { raw(value ? "true" : "false"); }
  void null() { raw("null"); }
  void raw(std::string_view value); // a value that is JSON already, on one line

  // The document, ended by a line feed; with a sink its end goes there, and nothing is returned. Every object and array
  // must have been ended.
  std::string finish();

private:
  void begin(char bracket);
  void end(char bracket);
  void beforeValue();
  void breakLine();
  void appendQuoted(std::string_view value);

  JsonLayout m_layout;
  TextSink m_sink;
  std::string m_out;          // what the sink has not had yet
  std::vector<bool> m_filled; // for each open object or array: whether it holds anything yet
  bool m_afterKey = false;
};

} // namespace parity::base
