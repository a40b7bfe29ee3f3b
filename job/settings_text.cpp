#include "job/settings_text.h"

#include "job/conditions.h"

namespace parity::job {

std::string describeCaptureScale(const mobile::Options& options, bool hasCaptures) {
  const mobile::CaptureScale scale = mobile::captureScaleOf(options, hasCaptures);
  return "mobile reflections scaled: " + mobile::captureScaleNames()[static_cast<std::size_t>(scale)];
}

std::vector<std::pair<std::string, std::string>> describeSettings(const Settings& settings,
                                                                  const gpu::DeviceReport& device) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& list : {runConditions(settings, device), defaultConditions(settings, SceneRequest{})})
    for (const compare::Condition& condition : reported(list)) texts.emplace_back(condition.name, condition.text());
  return texts;
}

} // namespace parity::job
