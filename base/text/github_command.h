// One workflow command of GitHub Actions, which it shows as an annotation.
#pragma once

#include <filesystem>
#include <string>

namespace parity::base {

struct GithubCommand {
  bool error = false;         // else a warning
  std::string title, message; // the message may have several lines
  std::string file;           // where it belongs; empty: nowhere
  int line = 0;               // from 1
};

// "::error file=...,line=...,title=...::message" with a line feed. A file below `root` (the checkout) is named relative
// to it, one outside is left out: GitHub would not find it.
std::string toText(const GithubCommand& command, const std::filesystem::path& root);

} // namespace parity::base
