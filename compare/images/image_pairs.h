// Which pictures belong together: two files, two folders matched by name, or a list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity::compare {

struct FilePair {
  std::string name;                      // unique among the pairs; '/'-separated, never absolute
  std::filesystem::path reference, test; // the one that is missing is empty
  std::string missing;                   // not empty: why there is no pair, in words, with the file's name
  std::filesystem::path list = {};       // that the pair stands in, as it was named; empty: none
  int line = 0;                          // in it
};

struct FilePairs {
  std::vector<FilePair> pairs;      // sorted by name, or in the list's order; never empty
  bool many = false;                // from folders or a list, even if it is one
  std::vector<std::string> skipped; // in the folders, passed over: of no kind that pictures have, or hidden
};

// Two files (any two), or two folders: every picture below one (by its extension: of the formats that are read; links
// are followed; hidden files and folders are passed over) and its counterpart of the same relative path below the
// other; where there is none, one of the same stem and another extension, if that leaves no choice. A picture without
// counterpart, on either side, is a pair with `missing`.
// Throws Error: usage for a file and a folder; failed (exit 4) for what does not exist or folders without any pair.
FilePairs findPairs(const std::filesystem::path& reference, const std::filesystem::path& test);

// A list, one pair a line: the reference and the test, apart by white space; "..." around a path that holds some (in
// it, \" and \\ stand for " and \); # starts a comment; UTF-8, with or without a mark. Relative paths are taken from
// the list's folder. Throws Error (exit 4) "LIST: line 3: reason" for a line of other than two paths, an open quote,
// the same pair twice, no pairs.
FilePairs readPairList(const std::filesystem::path& list);

} // namespace parity::compare
