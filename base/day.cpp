#include "base/day.h"

#include <fmt/format.h>

namespace parity::base {

namespace {

std::optional<int> numberIn(std::string_view digits) {
  int value = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

} // namespace

std::optional<Day> dayFrom(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const std::optional<int> year = numberIn(text.substr(0, 4)), month = numberIn(text.substr(5, 2)),
                           day = numberIn(text.substr(8, 2));
  if (!year || !month || !day || *year < 1970) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  return date.ok() ? std::optional(Day(date)) : std::nullopt;
}

std::string textOf(Day day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

Day today() { return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()); }

int daysBetween(Day from, Day to) { return static_cast<int>((to - from).count()); }

} // namespace parity::base
