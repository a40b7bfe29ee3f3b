#include "job/settings_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/truth_comparison.h"
#include "mobile/renderer.h"

namespace parity::job {

namespace {

std::string describePrecision(const mobile::Options& options, const gpu::DeviceReport& device) {
  const mobile::Precision precision = mobile::precisionOn(device, options);
  const std::string name = mobile::precisionNames()[static_cast<std::size_t>(precision)];
  return precision == options.precision ? name : name + ", as the device has no shaderFloat16";
}

std::string describeTextures(base::AstcBlock block) {
  const std::string& name = base::astcBlockNames()[static_cast<std::size_t>(block)];
  return block == base::AstcBlock::none ? "as they are"
                                        : fmt::format("{}, {:.2f} bits a texel", name, base::bitsPerTexel(block));
}

} // namespace

std::vector<std::pair<std::string, std::string>>
describeSettings(const Settings& s, const base::DisplayTransform& display, const gpu::DeviceReport& device) {
  const auto nameOf = [](const std::vector<std::string>& names, auto value) {
    return names[static_cast<std::size_t>(value)];
  };
  std::vector<std::pair<std::string, std::string>> settings = {
      {"size", fmt::format("{}x{}", s.width, s.height)},
      {"samples", std::to_string(s.samples)},
      {"display", display.name()},
      {"exposure", fmt::format("{} EV", s.exposureEv)},
      {"background", fmt::format("{},{},{}", s.background.x, s.background.y, s.background.z)},
      {"sun extraction", s.extractSun ? "on" : "off"},
      {"specular anti-aliasing", s.specularAa == gpu::SpecularAa::toksvig ? "Toksvig" : "off"},
      {"shadows", s.shadows ? "on" : "off, but in scenes whose light has them"},
      {"shadow maps", fmt::format("{} texels, filter of {}", s.shadowMaps.mapSize, s.shadowMaps.filter)},
      {"highend geometry term", nameOf(highend::geometryTermNames(), s.highend.geometryTerm)},
      {"highend fresnel", nameOf(highend::fresnelNames(), s.highend.fresnel)},
      {"highend diffuse", nameOf(highend::diffuseNames(), s.highend.diffuse)},
      {"highend compensation", nameOf(highend::compensationNames(), s.highend.compensation)},
      {"highend off-specular", nameOf(highend::offSpecularNames(), s.highend.offSpecular)},
      {"mobile preset", s.mobile.preset},
      {"mobile precision", describePrecision(s.mobile, device)},
      {"mobile sky", fmt::format("{} SH coefficients", s.mobile.skyCoefficients)},
      {"mobile capture", fmt::format("{}, scaled: {}", nameOf(mobile::captureEncodingNames(), s.mobile.capture),
                                     nameOf(mobile::captureScaleNames(), s.mobile.captureScale))},
      {"mobile spot shadow", s.mobile.spotShadow ? "on" : "off"},
      {"mobile target", nameOf(gpu::outputTargetNames(), s.mobileTarget) +
                            (gpu::isDisplayed(s.mobileTarget) ? ", as displayed: light above white is cut off" : "")},
      {"mobile textures", describeTextures(s.mobileTextures)},
      {"materials", s.materials.empty() ? "all" : fmt::format("{}", fmt::join(s.materials, ", "))},
      {"fully rough", s.fullyRough.empty() ? "none" : fmt::format("{}", fmt::join(s.fullyRough, ", "))}};
  if (s.truth) settings.emplace_back("truth", describeTruth(s));
  return settings;
}

} // namespace parity::job
