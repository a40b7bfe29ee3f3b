// What the pictures of the calibration scene say of the engines whose pictures a scene is compared with.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "external/calibration.h"
#include "job/settings.h"
#include "scenes/suite/suite.h"

namespace parity::job {

class Calibrations {
public:
  explicit Calibrations(const Settings& settings) : m_settings(settings) {} // of the scene; they stay

  // Of an external that names one. Each file is read once. Throws Error (exit 3, not comparable) with file and reason
  // where it says that the pictures cannot be used: mirrored or turned; another curve than the suite's transfer, or
  // none that can be fitted; a filter that is too wide; an environment that is mirrored or turned by more than 1
  // degree.
  const external::Calibration& of(const scenes::ExternalPictures& external);

  // Of each file once: an environment that is not seen, a filter that is not like ours.
  const std::vector<std::string>& warnings() const { return m_warnings; }

private:
  void tell(const external::Calibration& calibration, const scenes::ExternalPictures& external);

  const Settings& m_settings;
  std::map<std::string, external::Calibration> m_known; // by file
  std::vector<std::string> m_warnings;
};

// How an external's pictures become light. Throws what Calibrations::of throws.
external::Encoding encodingOf(const scenes::ExternalPictures& external, Calibrations& calibrations);

} // namespace parity::job
