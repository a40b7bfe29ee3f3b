#include "mobile/options.h"

#include <fmt/format.h>

#include "base/error.h"

namespace parity::mobile {

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names = {"karis2014", "ue4-2020", "refit"};
  return names;
}

Options presetByName(const std::string& name) {
  if (name == "ue4-2020") return {};
  if (name == "karis2014")
    return {.preset = name,
            .environmentBrdf = EnvironmentBrdf::karis2014,
            .directLobe = DirectLobe::dApprox,
            .captureScale = CaptureScale::full,
            .localLights = false,
            .roughnessFloor = 0};
  if (name == "refit")
    return {.preset = name,
            .environmentBrdf = EnvironmentBrdf::refit,
            .directLobe = DirectLobe::refit,
            .captureScale = CaptureScale::occlusion,
            .capture = CaptureEncoding::rgb9e5,
            .sky = SkyForm::tinted,
            .roughnessFloor = 0};
  throw base::Error(base::ExitCode::usage, "--mobile-preset", name,
                    fmt::format("unknown; the presets are {}", fmt::join(presetNames(), ", ")));
}

const std::vector<std::string>& environmentBrdfNames() {
  static const std::vector<std::string> names = {"karis2014", "ue4", "refit"};
  return names;
}
CaptureScale captureScaleOf(const Options& options, bool hasCaptures) {
  if (options.captureScale != CaptureScale::automatic) return options.captureScale;
  return hasCaptures ? CaptureScale::mixing : CaptureScale::sky;
}

const std::vector<std::string>& precisionNames() {
  static const std::vector<std::string> names = {"fp16", "fp32"};
  return names;
}
const std::vector<std::string>& directLobeNames() {
  static const std::vector<std::string> names = {"d-approx", "calc-specular", "refit", "phong-approx"};
  return names;
}
const std::vector<std::string>& captureScaleNames() {
  static const std::vector<std::string> names = {"auto", "sky", "mixing", "full", "occlusion"};
  return names;
}
const std::vector<std::string>& captureEncodingNames() {
  static const std::vector<std::string> names = {"rgbm", "rgb9e5", "fp16"};
  return names;
}
const std::vector<std::string>& skyFormNames() {
  static const std::vector<std::string> names = {"4", "9", "tinted"};
  return names;
}

} // namespace parity::mobile
