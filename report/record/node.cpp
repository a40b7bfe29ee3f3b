#include "report/record/node.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace parity::report {

void Node::refuse(const std::string& reason) const {
  throw base::fileError(m_file, m_place.empty() ? "/" : m_place, reason);
}

Node Node::at(const std::string& key) const {
  if (!m_value.is_object()) refuse("is not an object");
  const auto found = m_value.find(key);
  if (found == m_value.end()) refuse(fmt::format("lacks '{}'", key));
  return {*found, m_file, m_place + "/" + key, m_depth};
}

bool Node::has(const std::string& key) const { return m_value.is_object() && m_value.contains(key); }

std::vector<Node> Node::items() const {
  if (!m_value.is_array()) refuse("is not a list");
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < m_value.size(); ++i)
    nodes.emplace_back(m_value[i], m_file, m_place + "/" + std::to_string(i), m_depth);
  return nodes;
}

std::vector<std::pair<std::string, Node>> Node::members() const {
  if (!m_value.is_object()) refuse("is not an object");
  std::vector<std::pair<std::string, Node>> nodes;
  for (const auto& [key, value] : m_value.items())
    nodes.emplace_back(key, Node(value, m_file, m_place + "/" + key, m_depth));
  return nodes;
}

bool Node::isNull() const { return m_value.is_null(); }

std::string Node::text() const {
  if (!m_value.is_string()) refuse("is not a string");
  return m_value.get<std::string>();
}

double Node::number() const {
  if (!m_value.is_number()) refuse("is not a number");
  return m_value.get<double>();
}

bool Node::flag() const {
  if (!m_value.is_boolean()) refuse("is neither true nor false");
  return m_value.get<bool>();
}

std::uint64_t Node::count() const {
  if (!m_value.is_number_unsigned()) refuse("is not a whole number of at least 0");
  return m_value.get<std::uint64_t>();
}

} // namespace parity::report
