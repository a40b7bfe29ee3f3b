// HDR environments from image files, cleaned of what no renderer can use.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image_io.h"
#include "scenes/builtin.h"
#include "scenes/environment.h"
#include "scenes/load.h"
#include "scenes/names.h"

namespace parity::scenes {

base::Image toRgb(base::Image image, const std::string& label) {
  if (image.width < 1 || image.height < 1 || image.pixels.empty())
    throw base::fileError(label, "", "the image has no pixels");
  if (image.channels != 1 && image.channels != 3 && image.channels != 4)
    throw base::fileError(label, "", fmt::format("{} channels where 1, 3 or 4 are needed", image.channels));
  if (image.channels == 3) return image;
  base::Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.pixelCount(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      rgb.pixels[3 * i + c] =
          image.pixels[i * static_cast<std::size_t>(image.channels) + (image.channels == 1 ? 0 : c)];
  return rgb;
}

CleanedCounts cleanRadiance(base::Image& radiance, const std::string& label) {
  float largest = -1;
  for (const float value : radiance.pixels)
    if (std::isfinite(value)) largest = std::max(largest, value);
  if (largest < 0 &&
      std::none_of(radiance.pixels.begin(), radiance.pixels.end(), [](float value) { return std::isfinite(value); }))
    throw base::fileError(label, "", "no pixel of the environment is finite");
  largest = std::max(largest, 0.f);
  CleanedCounts counts;
  for (float& value : radiance.pixels) {
    if (std::isnan(value)) {
      ++counts.notANumber;
      value = 0;
    } else if (value < 0) { // -infinity too
      ++counts.negative;
      value = 0;
    } else if (std::isinf(value)) {
      ++counts.infinite;
      value = largest;
    }
    if (value > kMaxRadiance) {
      ++counts.tooLarge;
      value = kMaxRadiance;
    }
  }
  return counts;
}

Environment loadEnvironment(const std::string& fileOrBuiltin, float rotationDeg, std::vector<std::string>& warnings) {
  if (!std::isfinite(rotationDeg))
    throw base::Error(base::ExitCode::usage, "--env-rotation", "", "not a finite number of degrees");
  constexpr std::string_view kBuiltin = "builtin:";
  Environment environment;
  if (fileOrBuiltin.starts_with(kBuiltin))
    environment = makeBuiltinEnvironment(fileOrBuiltin.substr(kBuiltin.size()));
  else {
    const std::filesystem::path file(fileOrBuiltin);
    environment.name = cleanName(file.stem().string());
    try {
      environment.radiance = toRgb(base::decodeRadiance(base::readFile(file), fileOrBuiltin), fileOrBuiltin);
    } catch (const base::Error& error) { // the reader may know the file by another name
      throw base::fileError(fileOrBuiltin, "", error.reason());
    }
    const CleanedCounts counts = cleanRadiance(environment.radiance, fileOrBuiltin);
    if (counts.notANumber + counts.infinite + counts.negative > 0)
      warnings.push_back(fmt::format("environment {}: of {} values, {} NaN and {} negative became 0, {} infinite the "
                                     "largest finite",
                                     environment.name, environment.radiance.pixels.size(), counts.notANumber,
                                     counts.negative, counts.infinite));
    if (counts.tooLarge > 0)
      warnings.push_back(fmt::format("environment {}: {} of {} values are above {:g} and became that", environment.name,
                                     counts.tooLarge, environment.radiance.pixels.size(), kMaxRadiance));
  }
  environment.rotationDeg = rotationDeg;
  return environment;
}

} // namespace parity::scenes
