// JSON read from a file while it is parsed: only what is wanted of it takes memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace parity::report {

// Which keys of a value are wanted: of an object its own, of a list those of each of its elements.
struct Wanted {
  bool all = false; // of a value that is wanted as it is
  std::map<std::string, Wanted, std::less<>> keys;
};

// One list of the root object that is too long to be held: `take` gets its elements one by one, in order. It must not
// throw.
struct TakenList {
  std::string key;
  std::function<void(nlohmann::json element, std::size_t index)> take;
};

// The root without what is not wanted; the taken list is empty there, and is as it stands where it is no list. Throws
// Error (exit 4): "file: byte N: is not JSON" with those words of `what`, or the file cannot be read.
nlohmann::json readWanted(const std::filesystem::path& file, const Wanted& wanted, const TakenList& list,
                          const std::string& what);

} // namespace parity::report
