#include "base/knob/knob.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/nearest.h"
#include "base/text/shown_text.h"

namespace parity::base {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& wanted) {
  throw KnobError{fmt::format("'{}' is not {}", plainLine(text), wanted)};
}

// The whole text as a number, or nothing.
std::optional<double> numberOf(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || std::isspace(static_cast<unsigned char>(text[0])) || *end != '\0') return std::nullopt;
  return value;
}

} // namespace

GivenKnobs merged(const GivenKnobs& weaker, const GivenKnobs& stronger) {
  GivenKnobs all = stronger;
  all.insert(weaker.begin(), weaker.end());
  return all;
}

std::string keyOf(std::string_view id) {
  std::string key(id);
  std::ranges::replace(key, '-', '_');
  return key;
}

bool readFlag(const std::string& text) {
  if (text != "on" && text != "off") refuse(text, "on or off");
  return text == "on";
}

double readNumber(const std::string& text, double least, double most) {
  const std::optional<double> value = numberOf(text);
  if (!value || !(*value >= least && *value <= most)) refuse(text, fmt::format("a number from {} to {}", least, most));
  return *value;
}

long long readWhole(const std::string& text, double least, double most) {
  const std::optional<double> value = numberOf(text);
  if (!value || !(*value >= least && *value <= most) || *value != std::floor(*value))
    refuse(text, fmt::format("a whole number from {} to {}", least, most));
  return static_cast<long long>(*value);
}

std::vector<float> readNumbers(const std::string& text, const std::string& form) {
  std::vector<float> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> value = numberOf(text.substr(begin, end - begin));
    // Rounded once: by way of double a text may become the other of two neighbours.
    const float number = value ? std::strtof(text.c_str() + begin, nullptr) : NAN;
    if (!std::isfinite(number)) refuse(text, form);
    numbers.push_back(number);
    begin = end + 1;
  }
  if (numbers.size() != static_cast<std::size_t>(std::ranges::count(form, ',')) + 1) refuse(text, form);
  return numbers;
}

std::size_t readChoice(const std::string& text, const std::vector<std::string>& choices) {
  const auto found = std::ranges::find(choices, text);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const std::vector<std::string_view> known(choices.begin(), choices.end());
  std::string hint = describeNearest(text, known);
  if (hint.starts_with("did")) hint += fmt::format(" ({})", fmt::join(choices, ", "));
  throw KnobError{fmt::format("'{}' is unknown; {}", plainLine(text), hint)};
}

double readShare(const std::string& text) {
  const bool percent = text.ends_with('%');
  const std::optional<double> value = numberOf(percent ? text.substr(0, text.size() - 1) : text);
  const double share = value ? (percent ? *value / 100 : *value) : NAN;
  if (!(share >= 1e-6 && share <= 1)) refuse(text, "a share from 0.0001% to 100%, such as 0.5% or 0.005");
  return share;
}

double readSeconds(const std::string& text) {
  const auto refuse = [&] { return KnobError{"'" + text + "' is not a time such as 300s, 5m or 2h"}; };
  const std::size_t digits = std::min(text.find_first_of("smh"), text.size());
  if (digits + 1 < text.size()) throw refuse();
  const double unit = digits == text.size() || text[digits] == 's' ? 1 : text[digits] == 'm' ? 60 : 3600;
  try {
    constexpr double kMost = 1e6;
    const double value = readNumber(text.substr(0, digits), 0, kMost);
    if (value > 0) return value * unit;
  } catch (const KnobError&) {
  }
  throw refuse();
}

std::size_t readBytes(const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  const char* const end = text.data() + text.size();
  std::uint64_t count = 0;
  auto [rest, error] = std::from_chars(text.data(), end, count);
  int shift = 0;
  if (error == std::errc() && rest != end)
    if (const auto unit = kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(*rest))));
        unit != std::string_view::npos)
      shift = 10 * (static_cast<int>(unit) + 1), ++rest;
  if (error != std::errc() || rest != end || count == 0 || count > std::numeric_limits<std::uint64_t>::max() >> shift)
    refuse(text, "a size of at least one byte, such as 500M or 4G");
  return count << shift;
}

std::string numberText(double value) { return fmt::format("{}", value); }
std::string numberText(float value) { return fmt::format("{}", value); }

std::string numbersText(const float* values, std::size_t count) {
  return fmt::format("{}", fmt::join(values, values + count, ","));
}

std::string listText(const KnobValue& list, const char* none) {
  std::string all;
  for (const std::string& text : list) {
    all += all.empty() ? "'" : ", '";
    for (const char c : text) {
      if (c == '\'' || c == '\\') all += '\\';
      all += c;
    }
    all += "'";
  }
  return all.empty() ? none : all;
}

} // namespace parity::base
