// The baseline's pictures, kept with a report where this run's are not the same.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "job/view/view_pictures.h"
#include "report/report.h"

namespace parity::job {

class BaselinePictures {
public:
  // file: report.json of the baseline, which must outlive this. Pictures in `reportFolder`, which is cleaned before the
  // run, are read at once, up to kMostHeldBytes in all; others when they are needed.
  BaselinePictures(const report::Report& baseline, const std::filesystem::path& file,
                   const std::filesystem::path& reportFolder);

  // The bytes of a picture of this run, by its name in the report.
  using OwnPicture = std::function<std::vector<std::byte>(const std::string& file)>;

  // Takes a file to write.
  using Keep = std::function<void(EncodedPicture picture)>;

  // Names in the report, which was compared with the baseline, each picture of it that this run shows otherwise, and
  // gives the files to write, one by one: baseline/HASH.png, each content once. None for a picture that is missing,
  // damaged, of another size, or not below the baseline's folder; that is no error.
  void keepChanged(report::Report& report, const OwnPicture& own, const Keep& keep) const;

  static constexpr std::size_t kMostHeldBytes = std::size_t{512} << 20;

private:
  // The bytes of the baseline's picture, where they show something else; else nothing.
  std::vector<std::byte> readIfChanged(const std::string& before, const std::string& now, const OwnPicture& own) const;
  std::vector<std::byte> read(const std::string& name, std::size_t maxBytes) const;
  void holdAll();

  const report::Report& m_baseline;
  std::filesystem::path m_folder; // empty: its pictures are not to be had
  std::map<std::string, std::vector<std::byte>> m_held;
  bool m_isHeld = false;
};

// Whether keepChanged could have given this name to a file of baseline/.
bool isBaselinePicture(std::string_view name);

} // namespace parity::job
