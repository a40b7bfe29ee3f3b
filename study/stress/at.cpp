// --at FUNCTION:in1,in2,...: one input by hand, to the last bit.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/device/device.h"
#include "study/stress/function_stress.h"

namespace parity::stress {

namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw base::Error(base::ExitCode::usage, "--at", text, reason);
}

double parseNumber(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    refuse(whole, fmt::format("'{}' is not a number", text));
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::string describeResult(const FunctionCase& function, const Result& result, const Result& reference,
                           Precision precision) {
  std::string text;
  for (int k = 0; k < function.outputs; ++k) {
    text += fmt::format("{}{}", k > 0 ? ", " : "", formatExactly(result[k]));
    if (precision == Precision::f64 || !std::isfinite(result[k])) continue;
    const double scale = std::max({std::fabs(reference[k]), function.errorScale, formatOf(precision).smallestNormal});
    const double error = std::fabs(result[k] - reference[k]) / scale;
    if (error > 0) text += fmt::format(" (error {:.3g})", error);
  }
  return text;
}

} // namespace

std::string formatExactly(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  return fmt::format("{}", value);
}

std::string formatAt(const FunctionCase& function, const Row& row) {
  std::string text = function.name + ":";
  for (int n = 0; n < function.domain.numbers(); ++n)
    text += (n > 0 ? "," : "") + formatExactly(row[function.domain.position(n)]);
  return text;
}

At parseAt(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) refuse(text, "is not FUNCTION:number,number,...");
  const std::string name = text.substr(0, colon), numbers = text.substr(colon + 1);
  At at;
  at.function = functionsNamed(name).front();
  if (at.function.name != name) refuse(text, "has a pattern; give the whole name of one function");
  const Domain& domain = at.function.domain;
  const std::vector<std::string> parts = numbers.empty() ? std::vector<std::string>{} : split(numbers, ',');
  if (static_cast<int>(parts.size()) != domain.numbers()) {
    std::string names;
    for (int n = 0; n < domain.numbers(); ++n) names += (n > 0 ? ", " : "") + domain.nameOf(n);
    refuse(text, fmt::format("has {} numbers, but {} needs {}: {}", parts.size(), name, domain.numbers(), names));
  }
  for (int n = 0; n < domain.numbers(); ++n)
    at.row[domain.position(n)] = parseNumber(parts[static_cast<std::size_t>(n)], text);
  return at;
}

std::string describeAt(const At& at, const gpu::Device* device) {
  const FunctionCase& function = at.function;
  std::string text = formatAt(function, at.row) + "\n";
  for (int n = 0; n < function.domain.numbers(); ++n)
    text += fmt::format("  {:<22} {}\n", function.domain.nameOf(n), formatExactly(at.row[function.domain.position(n)]));
  if (!function.domain.contains(at.row)) text += "  outside the function's domain\n";
  for (const bool onDevice : {false, true})
    for (const Precision precision : kPrecisions) {
      if (onDevice && (!device || precision == Precision::f64)) continue;
      const std::string label = fmt::format("{} {}", onDevice ? "device" : "cpu", stress::nameOf(precision));
      if (onDevice && precision == Precision::f16 && !device->report().float16) {
        text += fmt::format("{:<12} skipped: no shaderFloat16\n", label);
        continue;
      }
      const Row row = roundTo(precision, function.domain, at.row);
      const Result result = onDevice ? deviceEvaluator(*device, function.id, precision)({row}).front()
                                     : evaluateRounded(precision, function.id, row);
      text +=
          fmt::format("{:<12} {}\n", label, describeResult(function, result, evaluate64(function.id, row), precision));
    }
  return text;
}

} // namespace parity::stress
