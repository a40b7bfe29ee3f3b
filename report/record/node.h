// A value of a JSON document, and the way to it for messages.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "report/reader.h"

namespace parity::report {

// Refers to a value of a document that must outlive it. Whatever is not as asked throws Error (exit 4), which names the
// file and the value's place.
class Node {
public:
  Node(const nlohmann::json& value, std::string file, std::string place, ReadDepth depth = ReadDepth::figures)
      : m_value(value), m_file(std::move(file)), m_place(std::move(place)), m_depth(depth) {}

  [[noreturn]] void refuse(const std::string& reason) const;
  Node at(const std::string& key) const;
  bool has(const std::string& key) const;
  std::vector<Node> items() const;
  std::vector<std::pair<std::string, Node>> members() const;
  bool isNull() const;
  ReadDepth depth() const { return m_depth; }
  std::string text() const;
  double number() const;
  bool flag() const;
  std::uint64_t count() const;

private:
  const nlohmann::json& m_value;
  std::string m_file, m_place;
  ReadDepth m_depth;
};

} // namespace parity::report
