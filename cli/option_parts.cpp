#include "cli/option_parts.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/nearest.h"
#include "cli/output.h"
#include "scenes/names.h"

namespace parity::cli {

CLI::ValidationError invalid(const std::string& option, const std::string& value, const std::string& wanted) {
  return CLI::ValidationError(option, fmt::format("'{}' is not {}", value, wanted));
}

std::vector<float> parseNumbers(const std::string& option, const std::string& text, std::size_t count,
                                const std::string& wanted) {
  std::vector<float> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    char* end = nullptr;
    const float value = std::strtof(part.c_str(), &end);
    if (part.empty() || *end != '\0' || !std::isfinite(value)) throw invalid(option, text, wanted);
    numbers.push_back(value);
  }
  if (numbers.size() != count || text.back() == ',') throw invalid(option, text, wanted);
  return numbers;
}

double parseShare(const std::string& option, const std::string& text) {
  char* end = nullptr;
  double share = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '%') share /= 100, ++end;
  if (end == text.c_str() || *end != '\0' || !(share >= 1e-6 && share <= 1))
    throw invalid(option, text, "a share of 0.0001% to 100%, as 0.5% or 0.005");
  return share;
}

std::uintmax_t parseBytes(const std::string& option, const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  const char* const end = text.data() + text.size();
  std::uintmax_t count = 0;
  auto [rest, error] = std::from_chars(text.data(), end, count);
  int shift = 0;
  if (error == std::errc() && rest != end)
    if (const auto unit = kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(*rest))));
        unit != std::string_view::npos)
      shift = 10 * (static_cast<int>(unit) + 1), ++rest;
  if (error != std::errc() || rest != end || count == 0 || count > std::numeric_limits<std::uintmax_t>::max() >> shift)
    throw invalid(option, text, "a size of at least a byte, as 500M or 4G");
  return count << shift;
}

CLI::Validator within(double least, double most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[=](std::string& text) {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool good = !text.empty() && *end == '\0' && value >= least && value <= most;
            return good ? std::string() : fmt::format("'{}' is not a number from {}", text, range);
          },
          range};
}

CLI::Validator oneOf(const std::vector<std::string>& names) {
  return {[=](std::string& text) {
            if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
            const std::vector<std::string_view> known(names.begin(), names.end());
            return fmt::format("'{}' is unknown; {}", scenes::cleanName(text), base::describeNearest(text, known));
          },
          fmt::format("{{{}}}", fmt::join(names, ","))};
}

CLI::Validator fileOfKind(const std::vector<std::string>& extensions) {
  return {[=](std::string& file) {
            if (std::count(extensions.begin(), extensions.end(), extensionOf(file)) > 0) return std::string();
            return fmt::format("'{}' is none of the kinds {}", file, fmt::join(extensions, ", "));
          },
          "FILE"};
}

} // namespace parity::cli
