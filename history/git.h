// What git knows of commits: asked by a list of arguments, never through a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace parity::history {

// A repository; where git or the repository is missing nothing is known. Commits are 40 hexadecimal digits (64 of
// SHA-256).
class Git {
public:
  // folder: any of its work tree.
  explicit Git(std::filesystem::path folder);

  bool isThere() const;
  // The commit of any name: "HEAD", "main", "v1.2", digits. Nothing where there is none.
  std::optional<std::string> commit(const std::string& name) const;
  std::optional<std::string> branch() const;                            // of HEAD; nothing where it is detached
  std::optional<std::string> commitTime(const std::string& name) const; // ISO 8601, UTC
  std::optional<std::string> mergeBase(const std::string& a, const std::string& b) const;
  // The commit and its ancestors, none before a child of its; `most` at most.
  std::vector<std::string> ancestors(const std::string& name, std::size_t most) const;

private:
  // The lines that it prints; nothing where it fails.
  std::optional<std::vector<std::string>> run(std::vector<std::string> arguments) const;
  std::optional<std::string> line(std::vector<std::string> arguments) const;

  std::filesystem::path m_folder;
  std::optional<std::string> m_program;
};

} // namespace parity::history
