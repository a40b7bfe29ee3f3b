// The report page read back as XML: its elements by path, and its outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace parity::report {

// Without what stands between the tags, which is raw text in HTML and not in XML; nothing where there are none.
inline std::string cutBetween(std::string html, const std::string& open, const std::string& close) {
  const std::size_t at = html.find(open);
  if (at == std::string::npos) return html;
  const std::size_t from = at + open.size();
  return html.erase(from, html.find(close, from) - from);
}

// The insides of a single file's <style> and <script> are left out; blocks of data are well-formed by themselves.
inline pugi::xml_document parse(const std::string& html) {
  const std::string xml = cutBetween(cutBetween(html, "<style>", "</style>"), "<script>", "</script>");
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_doctype);
  EXPECT_TRUE(result) << result.description() << ": "
                      << xml.substr(std::max<std::ptrdiff_t>(result.offset, 60) - 60, 120);
  return document;
}

// Every element and attribute name with its depth: what stays the same whatever the texts are.
inline std::string outlineOf(const pugi::xml_node& root) {
  struct Walker : pugi::xml_tree_walker {
    std::string outline;
    bool for_each(pugi::xml_node& node) override {
      if (node.type() != pugi::node_element) return true;
      outline += std::string(static_cast<std::size_t>(depth()), ' ') + node.name();
      for (const auto& attribute : node.attributes()) outline += std::string(" @") + attribute.name();
      outline += '\n';
      return true;
    }
  } walker;
  pugi::xml_node(root).traverse(walker);
  return walker.outline;
}

inline std::vector<pugi::xpath_node> select(const pugi::xml_document& document, const char* path) {
  const pugi::xpath_node_set nodes = document.select_nodes(path);
  return {nodes.begin(), nodes.end()};
}

std::vector<pugi::xpath_node> select(pugi::xml_document&&, const char*) = delete; // the nodes would outlive it

// The text of the one element there.
inline std::string textAt(const pugi::xml_document& document, const char* path) {
  const auto nodes = select(document, path);
  EXPECT_EQ(nodes.size(), 1u) << path;
  return nodes.empty() ? std::string() : nodes.front().node().text().get();
}

} // namespace parity::report
