// Edit distance by the usual table, three rows of it.
#include "base/text/nearest.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace parity::base {
namespace {

// Names are short; this bounds the time that a hostile one may cost.
constexpr std::size_t kMaxBytes = 256;

// A list of names in a message ends here.
constexpr std::size_t kMostListed = 24;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// A part of what was written: a character, any one character, or any run of them.
struct Part {
  enum class Kind { literal, one, run } kind = Kind::literal;
  char c = 0;
  bool is(char other) const { return kind == Kind::one || (kind == Kind::literal && lower(c) == lower(other)); }
};

std::vector<Part> partsOf(std::string_view text) {
  std::vector<Part> parts;
  for (const char c : text.substr(0, kMaxBytes)) parts.push_back({.c = c});
  return parts;
}

std::vector<Part> partsOfGlob(std::string_view glob) {
  glob = glob.substr(0, kMaxBytes);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < glob.size(); ++i) {
    // ']' is a member where it stands first.
    const std::size_t closes = glob[i] == '[' ? glob.find(']', i + 2) : std::string_view::npos;
    if (closes != std::string_view::npos) {
      parts.push_back({.kind = Part::Kind::one});
      i = closes;
    } else if (glob[i] == '*' || glob[i] == '?') {
      parts.push_back({.kind = glob[i] == '*' ? Part::Kind::run : Part::Kind::one});
    } else {
      parts.push_back({.c = glob[i]});
    }
  }
  return parts;
}

std::size_t distanceOf(const std::vector<Part>& a, std::string_view b) {
  b = b.substr(0, kMaxBytes);
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(beforeLast, last);
    std::swap(last, row);
    const Part& part = a[i - 1];
    const bool isRun = part.kind == Part::Kind::run;
    row[0] = isRun ? last[0] : i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      if (isRun) {
        row[j] = std::min(last[j], row[j - 1]);
        continue;
      }
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (part.is(b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && part.is(b[j - 2]) && a[i - 2].is(b[j - 1]))
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row[b.size()];
}

struct Found {
  std::string_view name;
  std::size_t distance = std::numeric_limits<std::size_t>::max();
};

Found findNearest(const std::vector<Part>& parts, std::span<const std::string_view> known) {
  Found best;
  for (const std::string_view candidate : known)
    if (const std::size_t distance = distanceOf(parts, candidate); distance < best.distance)
      best = {candidate, distance};
  return best;
}

std::string question(std::string_view prefix, std::string_view name) {
  return "did you mean '" + std::string(prefix) + std::string(name) + "'?";
}

std::string listOf(std::span<const std::string_view> known, std::string_view prefix) {
  std::string list = "known:";
  const std::size_t listed = std::min(known.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i) ((list += i == 0 ? " " : ", ") += prefix) += known[i];
  if (listed < known.size()) list += " and " + std::to_string(known.size() - listed) + " more";
  return list;
}

} // namespace

std::size_t editDistance(std::string_view a, std::string_view b) { return distanceOf(partsOf(a), b); }

std::string nearestName(std::string_view name, std::span<const std::string_view> known) {
  return std::string(findNearest(partsOf(name), known).name);
}

std::string askNearest(std::string_view name, std::span<const std::string_view> known, std::string_view prefix) {
  const Found nearest = findNearest(partsOf(name), known);
  if (nearest.name.empty() || nearest.distance * 2 > std::max(name.size(), nearest.name.size())) return {};
  return question(prefix, nearest.name);
}

std::string describeNearest(std::string_view name, std::span<const std::string_view> known, std::string_view prefix) {
  const std::string asked = askNearest(name, known, prefix);
  return asked.empty() ? listOf(known, prefix) : asked;
}

std::string describeNearestToGlob(std::string_view glob, std::span<const std::string_view> known) {
  const std::vector<Part> parts = partsOfGlob(glob);
  const Found nearest = findNearest(parts, known);
  const auto isLiteral = [](const Part& part) { return part.kind == Part::Kind::literal; };
  const auto literals = static_cast<std::size_t>(std::ranges::count_if(parts, isLiteral));
  const bool isWhole = literals == parts.size();
  const std::size_t letters = isWhole ? std::max(literals, nearest.name.size()) : literals;
  return !nearest.name.empty() && nearest.distance * 2 <= letters ? question({}, nearest.name) : listOf(known, {});
}

} // namespace parity::base
