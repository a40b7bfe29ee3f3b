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

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
  a = a.substr(0, kMaxBytes);
  b = b.substr(0, kMaxBytes);
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(beforeLast, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearestName(std::string_view name, std::span<const std::string_view> known) {
  std::string_view best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : known) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return std::string(best);
}

std::string describeNearest(std::string_view name, std::span<const std::string_view> known, std::string_view prefix) {
  const std::string nearest = nearestName(name, known);
  if (!nearest.empty() && editDistance(name, nearest) * 2 <= std::max(name.size(), nearest.size()))
    return "did you mean '" + std::string(prefix) + nearest + "'?";
  std::string list = "known:";
  for (const std::string_view each : known) ((list += each == known.front() ? " " : ", ") += prefix) += each;
  return list;
}

} // namespace parity::base
