// Days of the calendar from text and back.
#include "base/day.h"

#include <gtest/gtest.h>

namespace parity::base {
namespace {

TEST(Day, ComesBackAsItWasWritten) {
  for (const char* text : {"1970-01-01", "2024-02-29", "2027-02-01", "9999-12-31"}) {
    ASSERT_TRUE(dayFrom(text)) << text;
    EXPECT_EQ(textOf(*dayFrom(text)), text);
  }
}

TEST(Day, WhatIsNoDayIsNone) {
  for (const char* text : {"", "2027", "2027-2-1", "2027-02-30", "2023-02-29", "2027-13-01", "2027-00-01", "2027-01-00",
                           "1969-12-31", "27-02-2001", "2027-02-01 ", "2027/02/01", "+027-02-01", "2027-02-0x"})
    EXPECT_FALSE(dayFrom(text)) << text;
}

TEST(Day, DifferencesCountLeapDays) {
  const auto between = [](const char* from, const char* to) { return daysBetween(*dayFrom(from), *dayFrom(to)); };
  EXPECT_EQ(between("2024-02-28", "2024-03-01"), 2);
  EXPECT_EQ(between("2023-02-28", "2023-03-01"), 1);
  EXPECT_EQ(between("2027-01-01", "2026-12-31"), -1);
}

TEST(Day, TodayIsAfterThisTestWasWritten) { EXPECT_GT(today(), *dayFrom("2024-01-01")); }

} // namespace
} // namespace parity::base
