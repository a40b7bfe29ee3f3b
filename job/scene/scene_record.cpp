#include "job/scene/scene_record.h"

#include <cassert>

#include "report/pixel_chunk.h"
#include "report/record/archive.h"
#include "report/record/report_records.h"

namespace parity::report {

template <>
inline constexpr auto kRecord<job::EncodedPicture> = record<job::EncodedPicture>("", "",
                                                                                 hidden(&job::EncodedPicture::file),
                                                                                 hidden(&job::EncodedPicture::bytes));
template <>
inline constexpr auto kRecord<job::SceneRecord> = record<job::SceneRecord>("", "", hidden(&job::SceneRecord::result),
                                                                           hidden(&job::SceneRecord::prefixes),
                                                                           hidden(&job::SceneRecord::pictures));

} // namespace parity::report

namespace parity::job {

std::vector<std::byte> toBytes(const SceneRecord& record) {
  assert(record.result.error.empty());
  report::Writer write;
  write(record);
  return write.bytes();
}

std::optional<SceneRecord> recordFromBytes(std::span<const std::byte> bytes) {
  try {
    report::Reader read(bytes);
    SceneRecord record;
    read(record);
    if (read.atEnd() && record.prefixes.size() == record.result.views.size()) return record;
  } catch (const std::out_of_range&) { // not whole
  }
  return std::nullopt;
}

void renamePictures(SceneRecord& record, const std::vector<std::string>& prefixes) {
  assert(prefixes.size() == record.prefixes.size());
  const auto rename = [&](std::string& name, std::size_t view) {
    const std::string before = "images/" + record.prefixes[view] + "_";
    if (name.starts_with(before)) name.replace(0, before.size(), "images/" + prefixes[view] + "_");
  };
  const auto renamePixels = [&](std::string& name, std::size_t view) {
    for (const char* end : {".js", "_terms.js"})
      if (name == "pixels/" + record.prefixes[view] + end) {
        name = "pixels/" + prefixes[view] + end;
        return true;
      }
    return false;
  };
  const auto renameAll = [&](report::ImageSet& images, std::optional<compare::Truth>& truth, std::size_t view) {
    for (std::string* name : {&images.reference, &images.test, &images.flip}) rename(*name, view);
    if (!truth) return;
    for (std::string* name : {&truth->images.truth, &truth->images.referenceFlip, &truth->images.testFlip})
      rename(*name, view);
  };
  for (std::size_t v = 0; v < prefixes.size(); ++v) {
    report::ViewResult& view = record.result.views[v];
    renameAll(view.images, view.truth, v);
    for (std::string* name : {&view.pixels.color, &view.pixels.terms}) renamePixels(*name, v);
    for (report::MaterialResult& material : view.materials) renameAll(material.crops, material.truth, v);
  }
  for (EncodedPicture& picture : record.pictures)
    for (std::size_t v = 0; v < prefixes.size(); ++v) {
      if (renamePixels(picture.file, v)) {
        report::renameChunk(picture.bytes, picture.file);
        break;
      }
      const std::string before = "images/" + record.prefixes[v] + "_";
      if (!picture.file.starts_with(before)) continue;
      rename(picture.file, v);
      break; // its new name may begin as another view's old one
    }
  record.prefixes = prefixes;
}

} // namespace parity::job
