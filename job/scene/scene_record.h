// What a compared scene leaves in the cache: its part of the report, as measured and not yet judged, and its pictures.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "job/view/view_pictures.h"
#include "report/report.h"

namespace parity::job {

struct SceneRecord {
  report::SceneResult result;        // without verdicts, checks, rules and changes since a baseline
  std::vector<std::string> prefixes; // of each view's pictures (imagePrefix of job/report_folder.h)
  std::vector<EncodedPicture> pictures;
};

// Every figure comes back bit for bit. Judged members of the result are left out.
std::vector<std::byte> toBytes(const SceneRecord& record);
// Nothing where the bytes are no record.
std::optional<SceneRecord> recordFromBytes(std::span<const std::byte> bytes);

// Gives the pictures of a scene that now stands elsewhere in the run the names that they would have there; as many
// prefixes as views.
void renamePictures(SceneRecord& record, const std::vector<std::string>& prefixes);

} // namespace parity::job
