#include "job/scene/external_calibration.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "external/picture.h"

namespace parity::job {

namespace {

class Check {
public:
  Check(const external::Calibration& calibration, const scenes::ExternalPictures& external)
      : m_calibration(calibration), m_external(external) {}

  void requireAll() const {
    requireUpright();
    requireCurve();
    if (m_calibration.filterWidth > external::kWidestFilter)
      refuse(fmt::format("its filter is as wide as a box of {:.2f} pixels; at most {} can be compared",
                         m_calibration.filterWidth, external::kWidestFilter));
    requireEnvironment();
  }

private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw base::Error(base::ExitCode::notComparable, m_external.calibration, "", reason);
  }

  void requireUpright() const {
    if (m_calibration.placement.mirrored) refuse("is mirrored");
    if (m_calibration.quarterTurns != 0)
      refuse(fmt::format("is turned by {} degrees", 90 * m_calibration.quarterTurns));
  }

  void requireCurve() const {
    const external::CurveFit& curve = m_calibration.curves.front();
    if (m_external.transfer == external::kFitted) {
      if (!m_calibration.fitted || m_calibration.mixing > external::kMostMixing)
        refuse(fmt::format("no curve can be fitted. {}", external::describeFit(m_calibration)));
      return;
    }
    const std::string name = external::nameOf(curve.transfer);
    if (curve.error > external::kMostCurveError)
      refuse(fmt::format("its tone curve is none of the known ones (the nearest, {}, is {:.1f} of 255 away). {}", name,
                         curve.error, external::describeFit(m_calibration)));
    if (name != m_external.transfer)
      refuse(fmt::format("its tone curve is {}; the transfer of {} is {}", name, m_external.name, m_external.transfer));
  }

  void requireEnvironment() const {
    constexpr double kMostTurnDeg = 1;
    const auto& turn = m_calibration.environment;
    if (!turn) return;
    if (turn->isMirrored) refuse("its environment is mirrored");
    if (turn->angleDeg > kMostTurnDeg)
      refuse(fmt::format("its environment is turned by {:.1f} degrees ({:+.1f} about the vertical)", turn->angleDeg,
                         turn->yawDeg));
  }

  const external::Calibration& m_calibration;
  const scenes::ExternalPictures& m_external;
};

constexpr double kLeastFilterWidth = 0.3; // that --filter-width takes, in tenths

// How to render ours under the same filter; empty: it is the same.
std::string filterAdvice(double theirs, const Settings& settings) {
  const double ours = settings.samples > 1 ? settings.filterWidth : 0;
  if (std::abs(theirs - ours) <= external::kSameFilter) return {};
  if (theirs == 0) return "it has one sample a pixel: --samples 1 renders ours alike";
  const std::string width = fmt::format("its filter is as wide as a box of {:.2f} pixels, ours {}", theirs,
                                        ours == 0 ? "is one sample" : fmt::format("{:.2f}", ours));
  const std::string samples = ours == 0 ? " --samples 16" : "";
  const bool isOne = ours == 0 && std::abs(theirs - 1) <= external::kSameFilter;
  return fmt::format("{}:{}{} renders ours alike", width, samples,
                     isOne ? std::string()
                           : fmt::format(" --filter-width {:.1f}", std::max(theirs, kLeastFilterWidth)));
}

} // namespace

const external::Calibration& Calibrations::of(const scenes::ExternalPictures& external) {
  const std::string& file = external.calibration;
  auto found = m_known.find(file);
  if (found == m_known.end()) {
    found = m_known.emplace(file, external::calibrate(external::readValues(file), file)).first;
    tell(found->second, external);
  }
  Check(found->second, external).requireAll();
  return found->second;
}

void Calibrations::tell(const external::Calibration& calibration, const scenes::ExternalPictures& external) {
  if (calibration.placement.mirrored || calibration.quarterTurns != 0) return; // it is refused, and no more was read
  if (!calibration.environment)
    m_warnings.push_back(fmt::format("{}: the mirror ball does not show the environment's spots: whether {} is lit by "
                                     "the contract's environment is not known",
                                     external.calibration, external.name));
  if (const std::string advice = filterAdvice(calibration.filterWidth, m_settings); !advice.empty())
    m_warnings.push_back(
        fmt::format("{}: edges of {} differ from ours: {}", external.calibration, external.name, advice));
}

external::Encoding encodingOf(const scenes::ExternalPictures& external, Calibrations& calibrations) {
  if (external.transfer == external::kFitted) return external::Encoding(*calibrations.of(external).fitted);
  return *external::findTransfer(external.transfer);
}

} // namespace parity::job
