// What glTF 2.0 and the extensions that we read say about the types of properties, as data.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace parity::scenes {

enum class RuleKind {
  text,
  texts,
  boolean,
  count,
  number,
  numbers,
  index,
  indices,
  indexMap,
  indexMaps,
  object,
  objects
};

// One property of an object.
struct Rule {
  std::string_view key;
  RuleKind kind = RuleKind::object;
  bool required = false;
  std::size_t size = 0; // of an array of numbers; 0: any
  // The array of the document that an index points into: "accessors", or a path with '/'; none: any number will do.
  std::string_view target = {};
  std::span<const Rule> rules = {};               // of an object, or of each object of an array
  std::span<const std::string_view> choices = {}; // the texts that are allowed; none: any
  std::span<const int> codes = {};                // the counts that are allowed; none: any
};

// The properties of the whole document.
std::span<const Rule> gltfRules();

} // namespace parity::scenes
