#include "cli/load_options.h"

#include <fmt/format.h>

#include "base/image.h"
#include "cli/option_parts.h"

namespace parity::cli {

void addChoiceOptions(CLI::App& app, scenes::LoadOptions& load) {
  app.add_option("--time", load.timeSeconds, "The pose of the file's animations at this time, seconds")
      ->check(within(-scenes::kMaxPoseSeconds, scenes::kMaxPoseSeconds))
      ->group("Scene")
      ->capture_default_str();
  app.add_option("--animation", load.animation,
                 "Only this animation, by name or number; none: the rest pose. Default: all that\n"
                 "move nothing an earlier one does")
      ->group("Scene");
  app.add_option("--scene", load.scene, "The scene of the file, by name or number. Default: the file's own choice")
      ->group("Scene");
  app.add_option("--variant", load.variant, "The variant of its materials, by name or number. Default: none")
      ->group("Scene");
}

void addLimitOptions(CLI::App& app, RawLoadOptions& raw) {
  app.add_option("--max-image", raw.maxImage,
                 "SIDE or SIDE,MEGAPIXELS: largest texture, and all of a scene together. Default 16384,512")
      ->group("Scene");
  app.add_option("--max-memory", raw.maxMemory,
                 "Most that loading a scene may take: its files, meshes, images together, such as 512M; and most\n"
                 "for the pictures of --size. Default 4G")
      ->group("Scene");
}

void addLoadOptions(CLI::App& app, scenes::LoadOptions& load, RawLoadOptions& raw) {
  addChoiceOptions(app, load);
  app.add_option("--subject", raw.subject,
                 "scene, or ball: each material of the file on a sphere, so that every one is seen")
      ->check(CLI::IsMember({"scene", "ball"}))
      ->group("Scene")
      ->capture_default_str();
  addLimitOptions(app, raw);
}

const std::vector<std::string>& loadOptionNames() {
  static const std::vector<std::string> names = {"--time", "--animation", "--scene", "--variant", "--subject"};
  return names;
}

void settleLimits(scenes::LoadOptions& load, const RawLoadOptions& raw) {
  if (!raw.maxImage.empty()) {
    const bool both = raw.maxImage.find(',') != std::string::npos;
    const std::string wanted = fmt::format("SIDE from 1 to {}, or SIDE,MEGAPIXELS from 1 to 4096", base::kMaxImageSide);
    const auto n = parseNumbers("--max-image", raw.maxImage, both ? 2 : 1, wanted);
    if (!(n[0] >= 1 && n[0] <= static_cast<float>(base::kMaxImageSide)) || (both && !(n[1] >= 1 && n[1] <= 4096)))
      throw invalid("--max-image", raw.maxImage, wanted);
    load.maxImageSide = static_cast<std::size_t>(n[0]);
    if (both) load.maxImageTexels = static_cast<std::size_t>(n[1]) << 20;
  }
  if (!raw.maxMemory.empty()) load.maxMemoryBytes = parseBytes("--max-memory", raw.maxMemory);
}

void settleLoad(CommonOptions& common, const RawLoadOptions& raw) {
  if (raw.subject == "ball") common.subject = scenes::Subject::ball;
  settleLimits(common.load, raw);
}

} // namespace parity::cli
