#include "history/git.h"

#include <charconv>
#include <ctime>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/log.h"
#include "base/process.h"

namespace parity::history {

Git::Git(std::filesystem::path folder) : m_folder(std::move(folder)), m_program(base::findProgram("git")) {}

std::optional<std::vector<std::string>> Git::run(std::vector<std::string> arguments) const {
  if (!m_program) return std::nullopt;
  std::vector<std::string> words = {*m_program, "-C", m_folder.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const base::ProcessOutput output = base::runToEnd(words);
  if (output.end.exitCode == 0 && output.end.signal == 0) return output.lines;
  base::logDetail(
      fmt::format("git {}: {}", arguments.front(), output.errors.empty() ? "found nothing" : output.errors.front()));
  return std::nullopt;
}

std::optional<std::string> Git::line(std::vector<std::string> arguments) const {
  const auto lines = run(std::move(arguments));
  return lines && !lines->empty() && !lines->front().empty() ? std::optional(lines->front()) : std::nullopt;
}

bool Git::isThere() const { return line({"rev-parse", "--git-dir"}).has_value(); }

// A name that begins with '-' would be an option; git allows no such branch.
std::optional<std::string> Git::commit(const std::string& name) const {
  if (name.empty() || name.front() == '-') return std::nullopt;
  return line({"rev-parse", "--verify", "--quiet", name + "^{commit}"});
}

std::optional<std::string> Git::branch() const { return line({"symbolic-ref", "--quiet", "--short", "HEAD"}); }

std::optional<std::string> Git::commitTime(const std::string& name) const {
  const auto found = commit(name);
  const auto text = found ? line({"show", "--no-patch", "--format=%ct", *found}) : std::nullopt;
  std::time_t seconds = 0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), seconds).ec != std::errc())
    return std::nullopt;
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

std::optional<std::string> Git::mergeBase(const std::string& a, const std::string& b) const {
  const auto first = commit(a), second = commit(b);
  return first && second ? line({"merge-base", *first, *second}) : std::nullopt;
}

std::vector<std::string> Git::ancestors(const std::string& name, std::size_t most) const {
  const auto found = commit(name);
  if (!found) return {};
  return run({"rev-list", "--topo-order", fmt::format("--max-count={}", most), *found})
      .value_or(std::vector<std::string>());
}

} // namespace parity::history
