// Pictures of other engines as columns of a scene's views: read, put on the view's pixels, and made ready to be
// compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "job/scene/external_calibration.h"
#include "job/scene/view_rows.h"
#include "job/view/view_frames.h"
#include "scenes/scene.h"

namespace parity::job {

class ExternalPictureReader {
public:
  explicit ExternalPictureReader(const SceneRequest& request) // which stays
      : m_request(request), m_calibrations(request.settings) {}

  // Appends to the frames of a view, which its paths have rendered, one for each external column. Where no material is
  // seen they show what the first path shows. The frame of a picture that cannot be used has no colour: another size or
  // form, pixels of materials that are not opaque, a picture that lies more than half a pixel beside the view, or does
  // not show it. Throws nothing of these: problem() has them.
  void addTo(ViewFrames& frames, std::size_t view);

  // What had to be put right, and all problems but the first.
  std::vector<std::string> warnings() const;
  const std::vector<scenes::SourceFile>& sources() const { return m_sources; } // that were read
  // The first picture that cannot be used: exit 3 (not comparable) or 4 (cannot be read), with file and reason.
  const std::optional<base::Error>& problem() const { return m_problem; }

private:
  void addSource(const std::string& file);

  const SceneRequest& m_request;
  Calibrations m_calibrations;
  std::vector<std::string> m_warnings;
  std::vector<scenes::SourceFile> m_sources;
  std::optional<base::Error> m_problem;
};

// The file of a view's picture: {scene} and {view} of the pattern stand for their names, in which all ASCII characters
// but letters, digits and '-' are '_'. A folder means "{scene}-{view}.png" in it.
std::string pictureFileOf(const std::string& pattern, const std::string& scene, const std::string& view);

// All files of other engines that the request names: pictures of its views, and calibrations.
std::vector<std::string> externalFilesOf(const SceneRequest& request);

} // namespace parity::job
