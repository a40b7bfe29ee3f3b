// Days of the calendar, as ISO 8601 writes them: 2027-02-01.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace parity::base {

using Day = std::chrono::sys_days;

// Nothing where the text is no day of the calendar between the years 1970 and 9999.
std::optional<Day> dayFrom(std::string_view text);
std::string textOf(Day day);
// In UTC, as the times in run.json are.
Day today();
// How many days later `to` is; negative: earlier.
int daysBetween(Day from, Day to);

} // namespace parity::base
