#include "cli/options/option_parts.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/day.h"
#include "cli/output.h"

namespace parity::cli {

CLI::Option* choose(CLI::Option* option, const std::vector<std::string>& choices) {
  return option->type_name(fmt::format("{{{}}}", fmt::join(choices, ",")))
      ->check(CLI::Validator(
          [choices](const std::string& text) {
            try {
              base::readChoice(text, choices);
            } catch (const base::KnobError& error) {
              return error.reason;
            }
            return std::string();
          },
          ""));
}

CLI::Option* repeat(CLI::Option* option) { return option->allow_extra_args(false); }

CLI::ValidationError invalid(const std::string& option, const std::string& value, const std::string& wanted) {
  return CLI::ValidationError(option, fmt::format("'{}' is not {}", value, wanted));
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

CLI::Validator wholeWithin(std::uint64_t least, std::uint64_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[=](std::string& text) {
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good =
                error == std::errc() && end == text.data() + text.size() && value >= least && value <= most;
            return good ? std::string() : fmt::format("'{}' is not a whole number from {}", text, range);
          },
          range};
}

CLI::Validator dayValidator() {
  return {[](const std::string& text) {
            return base::dayFrom(text) ? std::string() : "'" + text + "' is not a day such as 2027-02-01";
          },
          "", ""};
}

CLI::Validator fileOfKind(const std::vector<std::string>& extensions) {
  return {[=](std::string& file) {
            if (std::count(extensions.begin(), extensions.end(), extensionOf(file)) > 0) return std::string();
            return fmt::format("'{}' is not a file of the kinds {}", file, fmt::join(extensions, ", "));
          },
          ""};
}

} // namespace parity::cli
