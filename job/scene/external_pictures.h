// Pictures of other engines as columns of a view: read, put on the view's pixels, and made ready to be compared.
#pragma once

#include <string>
#include <vector>

#include "job/scene/view_rows.h"
#include "job/view/view_frames.h"
#include "scenes/scene.h"

namespace parity::job {

// Appends to the frames of a view, which its paths have rendered, one for each external column. Where no material is
// seen they show what the first path shows. warnings: what had to be put right; sources: the files that were read.
// Throws Error (exit 3, not comparable) with file and reason: another size or form, pixels of materials that are not
// opaque, a picture that lies more than half a pixel beside the view, or does not show it.
void addExternalPictures(const SceneRequest& request, std::size_t view, ViewFrames& frames,
                         std::vector<std::string>& warnings, std::vector<scenes::SourceFile>& sources);

// The file of a view's picture: {scene} and {view} of the pattern stand for their names, in which all but letters,
// digits and '-' are '_'. A folder means "{scene}-{view}.png" in it.
std::string pictureFileOf(const std::string& pattern, const std::string& scene, const std::string& view);

} // namespace parity::job
