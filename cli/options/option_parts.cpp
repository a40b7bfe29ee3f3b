#include "cli/options/option_parts.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/output.h"

namespace parity::cli {

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

CLI::Validator fileOfKind(const std::vector<std::string>& extensions) {
  return {[=](std::string& file) {
            if (std::count(extensions.begin(), extensions.end(), extensionOf(file)) > 0) return std::string();
            return fmt::format("'{}' is not a file of the kinds {}", file, fmt::join(extensions, ", "));
          },
          "FILE"};
}

} // namespace parity::cli
