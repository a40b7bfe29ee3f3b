// The parser's events (SAX) build what is wanted; the rest is passed over.
#include "report/streamed_json.h"

#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"

namespace parity::report {
namespace {

using nlohmann::json;

// What nlohmann's parser tells: each function returns whether it goes on.
class Builder : public nlohmann::json_sax<json> {
public:
  Builder(const Wanted& wanted, const TakenList& list) : m_wanted(wanted), m_list(list) {}

  json takeRoot() { return std::move(m_root); }
  std::size_t failedAt() const { return m_failedAt; }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return true; } // JSON has none
  bool start_object(std::size_t) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (m_passedOver > 0) return true;
    const Wanted& wanted = *m_open.back().wanted;
    const auto found = wanted.keys.find(name);
    m_next = wanted.all ? &wanted : found == wanted.keys.end() ? nullptr : &found->second;
    m_key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    m_failedAt = position;
    return false;
  }

private:
  struct Open {
    json* value;
    const Wanted* wanted;
    bool isTaken = false; // the list whose elements are handed over
    std::size_t count = 0;
  };

  // Puts a value where the parser stands; null: it is not wanted. A taken element stays in m_element until it is whole.
  json* place(json&& value) {
    if (m_open.empty()) return &(m_root = std::move(value));
    Open& parent = m_open.back();
    if (parent.isTaken) return &(m_element = std::move(value));
    if (parent.value->is_array()) return &parent.value->emplace_back(std::move(value));
    return m_next ? &((*parent.value)[m_key] = std::move(value)) : nullptr;
  }
  void handOver() {
    if (!m_open.empty() && m_open.back().isTaken) m_list.take(std::exchange(m_element, json()), m_open.back().count++);
  }
  bool add(json&& value) {
    if (m_passedOver == 0 && place(std::move(value))) handOver();
    return true;
  }
  bool open(json&& value) {
    const bool isList = value.is_array();
    json* placed = m_passedOver > 0 ? nullptr : place(std::move(value));
    if (!placed) {
      ++m_passedOver;
      return true;
    }
    const bool inObject = !m_open.empty() && m_open.back().value->is_object();
    const bool isTaken = isList && inObject && m_open.size() == 1 && m_key == m_list.key;
    m_open.push_back({placed, m_open.empty() ? &m_wanted : inObject ? m_next : m_open.back().wanted, isTaken});
    return true;
  }
  bool close() {
    if (m_passedOver > 0) {
      --m_passedOver;
      return true;
    }
    m_open.pop_back();
    handOver();
    return true;
  }

  const Wanted& m_wanted;
  const TakenList& m_list;
  json m_root, m_element;
  std::vector<Open> m_open;
  std::string m_key;
  const Wanted* m_next = nullptr; // what is wanted of the key's value; null: nothing
  std::size_t m_passedOver = 0;   // how many objects and lists are open that are not wanted
  std::size_t m_failedAt = 0;
};

} // namespace

json readWanted(const std::filesystem::path& file, const Wanted& wanted, const TakenList& list,
                const std::string& what) {
  base::regularFileSize(file);
  std::vector<char> buffer(1 << 20);
  std::ifstream stream;
  stream.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  stream.open(file, std::ios::binary);
  if (!stream) throw base::fileError(file.string(), "", "cannot be opened");
  Builder builder(wanted, list);
  const bool isWhole = json::sax_parse(stream, &builder);
  if (stream.bad()) throw base::fileError(file.string(), "", "cannot be read");
  if (!isWhole) throw base::fileError(file.string(), fmt::format("byte {}", builder.failedAt()), what);
  return builder.takeRoot();
}

} // namespace parity::report
