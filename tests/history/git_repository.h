// A small git repository of a test's own.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/process.h"

namespace parity::tests {

class GitRepository {
public:
  static bool canMake() { return base::findProgram("git").has_value(); }

  // Makes the folder, with a branch `main`.
  explicit GitRepository(std::filesystem::path folder) : m_folder(std::move(folder)) {
    std::filesystem::create_directories(m_folder);
    run({"init", "--quiet", "--initial-branch=main"});
  }
  const std::filesystem::path& folder() const { return m_folder; }

  // Its output; throws where it fails.
  std::vector<std::string> run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words = {
        base::findProgram("git").value(), "-C", m_folder.string(),     "-c", "user.name=Test", "-c",
        "user.email=test@parity.example", "-c", "commit.gpgsign=false"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const base::ProcessOutput output = base::runToEnd(words);
    if (output.end.exitCode != 0)
      throw std::runtime_error("git " + arguments.front() + ": " +
                               (output.errors.empty() ? "" : output.errors.front()));
    return output.lines;
  }
  // All files as they are now; returns the commit.
  std::string commit(const std::string& message) const {
    run({"add", "--all"});
    run({"commit", "--quiet", "--allow-empty", "-m", message});
    return run({"rev-parse", "HEAD"}).at(0);
  }

private:
  std::filesystem::path m_folder;
};

} // namespace parity::tests
